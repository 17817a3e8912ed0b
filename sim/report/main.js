// SPDX-License-Identifier: Apache-2.0
//
// The page, from the top: what ran, verdicts, pictures, meshes, tables, plots. Sections that need a view share one:
// moving one of the sliders moves all.
import { choice, download, h, number, slider } from './dom.js';
import * as figures from './figures.js';
import { meshSection } from './mesh.js';
import { ACTIVITY, axis, PALETTE, plot } from './plot.js';
import { exports, sortedTable, tableBox } from './table.js';

const data = JSON.parse(document.getElementById('data').textContent);
const run = data.run, views = run.views ?? [];
const plots = [];

// --- The view that is looked at -------------------------------------------------------------------

const listeners = [], sliders = [];
const state = { index: 0, get view() { return views[this.index]?.view; }, onView: (f) => listeners.push(f) };

function look(index) {
  state.index = index;
  sliders.forEach((one) => one.set(index));
  listeners.forEach((f) => f());
}

function viewSlider(id) {
  const one = slider({ id, label: 'viewpoint', count: views.length, words: (i) => `${views[i]?.view ?? '–'} (${i + 1} of ${views.length})`, change: look });
  sliders.push(one);
  return one.element;
}

// --- Pieces ---------------------------------------------------------------------------------------

const section = (id, title, ...content) => h('section', { id }, h('h2', {}, title), content);
const facts = (list) => h('dl', {}, list.filter(([, value]) => value !== null && value !== undefined && value !== '')
  .map(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
const verdict = (text) => h('span', { class: text === 'equal' ? 'equal' : text === 'DIFFER' ? 'differ' : 'soft' }, text);
const addPlot = (options) => { const one = plot(options); plots.push(one); return one; };
const stacked = { stacked: true };

// --- What ran, and whether it holds ---------------------------------------------------------------

const viewRows = figures.viewRows(run);
const total = (key, rows = viewRows) => rows.reduce((all, row) => all + (row[key] ?? 0), 0);

function head() {
  const cycles = total('cycles'), bound = viewRows.reduce((all, row) => all + (row.cycles === null ? 0 : row.bound ?? 0), 0);
  const compared = viewRows.some((row) => row.verdict !== 'nothing compared');
  const complete = views.length === (run.views_asked ?? views.length);
  const good = run.equal !== false && complete;
  const word = !compared ? ['nothing compared', 'soft'] : good ? ['equal', 'equal'] : ['DIFFER', 'differ'];
  const card = (value, words, kind) => h('div', { class: 'card' }, h('b', { class: kind }, value), h('span', {}, words));
  return h('header', {}, h('h1', {}, document.title),
    h('p', { class: 'soft' }, `halfstep ${run.versions?.halfstep ?? ''}, commit ${run.versions?.commit ?? 'unknown'}, run.json of ${data.written}`),
    h('div', { class: 'cards' },
      card(word[0], compared ? 'all comparisons' : 'one engine alone', word[1]),
      card(`${views.length}${complete ? '' : ` of ${run.views_asked}`}`, 'views'),
      card(number(total('faces')), 'faces out'), card(cycles ? number(cycles) : '–', 'cycles'),
      card(cycles ? number(cycles / total('faces'), 2) : '–', 'cycles per face'),
      card(cycles ? number(cycles / bound, 3) : '–', 'cycles over bound')));
}

function whatRan() {
  const { mesh = {}, settings = {}, versions = {}, machine = {} } = run;
  const yes = (value) => (value ? 'yes' : 'no');
  const depths = settings.uniform !== null && settings.uniform !== undefined ? `${settings.uniform}, uniform`
    : `front ${settings.front}, silhouette ${settings.silhouette}`;
  return section('ran', 'What ran', h('div', { class: 'two' },
    facts([
      ['mesh', mesh.source], ['faces', number(mesh.faces)], ['vertices', number(mesh.vertices)], ['half-edges', number(mesh.halfedges)],
      ['engines', (settings.engines ?? []).join(', ')], ['depth', depths], ['boundary', settings.boundary], ['guard ring', yes(settings.guard)],
      ['limit positions', yes(settings.limit)], ['least edge', settings.min_edge_px ? `${settings.min_edge_px} pixels` : 'none'],
      ['forced depths', settings.force ?? 'none'],
    ]),
    facts([
      ['pictures', (settings.size ?? []).join(' × ')], ['stalls, in and out', (settings.stalls ?? []).map((s) => `${s} %`).join(', ')], ['seed', settings.seed],
      ['limits', `${number(settings.max_vertices)} vertices, ${number(settings.max_quads)} quads`], ['took', `${number(run.seconds, 1)} s`],
      ['processor', machine.processor], ['cores', machine.cores], ['memory', machine.memory ? `${number(machine.memory / 2 ** 30, 1)} GiB` : null],
      ['system', machine.system], ['compiler', versions.compiler], ['simulator', versions.simulator], ['stream format', versions.stream],
    ])));
}

function verdicts() {
  const columns = figures.COMPARISON_COLUMNS.map((c) => (c.key === 'verdict' ? { ...c, show: verdict } : c));
  const pictures = figures.pictureRows(run).filter((row) => row.b === 'reference');
  return section('verdicts', 'Verdicts',
    tableBox({ name: 'comparisons', label: 'Comparisons', columns, rows: figures.comparisonRows(run) }),
    pictures.length ? [h('h3', {}, 'Pictures beside the reference'),
      h('p', { class: 'soft' }, 'The reference is the uniform surface in doubles: what a view does not refine shows there. Pictures of engines are compared above, pixel by pixel.'),
      tableBox({ name: 'pictures', label: 'Pictures beside the reference', columns: figures.PICTURE_COLUMNS, rows: pictures })] : null);
}

// --- Pictures -------------------------------------------------------------------------------------

const CAPTIONS = {
  initial: 'initial mesh', refined: 'refined, from the viewpoint', 'refined-wires': 'refined: depth', side: 'from the side',
  'side-wires': 'from the side: depth', facing: 'facing, as classified', difference: 'difference to the reference',
};

function pictures() {
  const grid = h('div', { class: 'pictures' });
  const fill = () => {
    const found = data.pictures[String(state.view)] ?? {};
    grid.replaceChildren(...Object.entries(CAPTIONS).map(([name, caption]) => h('figure', {},
      found[name] ? h('img', { src: found[name], alt: `${caption}, view ${state.view}`, 'data-name': name })
        : h('div', { class: 'missing' }, 'not in this file'),
      h('figcaption', {}, caption))));
  };
  state.onView(fill);
  fill();
  return section('pictures', 'Pictures', h('div', { class: 'controls' }, viewSlider('view-pictures')), grid);
}

// --- Plots of a run -------------------------------------------------------------------------------

function cyclePlot() {
  const rows = figures.cycleRows(run);
  if (!rows.length) return null;
  const line = (label, key, dash) => ({ type: 'line', label, data: rows.map((r) => r[key]), ink: true, borderDash: dash, borderWidth: 2, pointStyle: 'line', pointRadius: 0, order: -1, stack: key });
  return addPlot({
    name: 'cycles', title: 'Cycles per view, by stage.',
    note: 'A stage\'s cycles at work (not idle) of the passes, which follow one another, and of receive; transform, quantize and emit work beside them and are in the numbers.',
    make: () => ({
      type: 'bar', columns: figures.CYCLE_COLUMNS, rows,
      data: {
        labels: rows.map((r) => r.view),
        datasets: [
          ...['receive', ...figures.PASSES].map((stage) => ({
            label: stage, data: rows.map((r) => r[stage]), backgroundColor: PALETTE[figures.STAGES.indexOf(stage)], stack: 'stages',
          })),
          line('bound (dashed)', 'bound', [6, 4]), line('cycles', 'cycles', []),
        ],
      },
      options: { interaction: { mode: 'index' }, scales: { x: axis('view', stacked), y: axis('cycles', { beginAtZero: true, ...stacked }) } },
    }),
  });
}

function generationPlots() {
  const rows = () => figures.generationRows(views[state.index] ?? {});
  const bars = (label, key, color) => (all) => ({ label, data: all.map((r) => r[key]), backgroundColor: color });
  const make = (sets, title) => () => {
    const all = rows();
    return {
      type: 'bar', columns: figures.GENERATION_COLUMNS, rows: all,
      data: { labels: all.map((r) => r.generation), datasets: sets.map((set) => set(all)) },
      options: { interaction: { mode: 'index' }, scales: { x: axis('generation'), y: axis(title, { beginAtZero: true }) } },
    };
  };
  const both = [addPlot({
    name: 'generation-faces', title: 'Faces per generation,', note: 'of the view above: active, wanted, refined, and those that left.',
    make: make([bars('active', 'active', PALETTE[4]), bars('selected', 'selected', PALETTE[1]), bars('refined', 'refined', PALETTE[2]), bars('left', 'final', PALETTE[0])], 'faces'),
  })];
  if (views.some((view) => figures.generationRows(view).some((g) => g.cycle !== null)))
    both.push(addPlot({
      name: 'generation-cycles', title: 'Cycles per generation,', note: 'from where the sequencer turns to it to where it turns to the next one.',
      make: make([bars('cycles', 'cycles', PALETTE[6])], 'cycles'),
    }));
  return both;
}

function utilizationPlot() {
  if (!figures.utilizationRows(run, null).length) return null;
  let which = 'all';
  const rows = () => figures.utilizationRows(run, which === 'all' ? null : state.view);
  const one = addPlot({
    name: 'utilization', title: 'Utilization:', note: 'what each stage did, in per cent of the cycles.',
    controls: [choice({ id: 'utilization-of', label: 'of', value: 'all', options: [['all', 'all views'], ['one', 'the chosen viewpoint']], change: (to) => { which = to; one.redraw(); } })],
    make: () => {
      const all = rows();
      const share = (row, activity) => 100 * row[activity] / figures.ACTIVITIES.reduce((n, a) => n + row[a], 0);
      return {
        type: 'bar', columns: figures.UTILIZATION_COLUMNS, rows: all,
        data: { labels: all.map((r) => r.stage), datasets: figures.ACTIVITIES.map((a) => ({ label: a, data: all.map((r) => share(r, a)), backgroundColor: ACTIVITY[a] })) },
        options: { indexAxis: 'y', interaction: { mode: 'index', axis: 'y' }, scales: { x: axis('% of the cycles', { ...stacked, max: 100 }), y: { ...stacked } } },
      };
    },
  });
  return one;
}

function sizePlot() {
  const all = [run, ...data.with], rows = figures.sizeRows(all);
  if (!rows.length) return null;
  let x = data.with.length ? 'mesh_faces' : 'faces';
  const names = [...new Set(rows.map((r) => r.mesh.replace(/(shape:[a-z]+):.*/, '$1')))];
  const most = (f, key) => f(...rows.map((r) => r[key]).filter((v) => v > 0));
  const decades = (key) => ({ min: 10 ** Math.floor(Math.log10(most(Math.min, key))), max: 10 ** Math.ceil(Math.log10(most(Math.max, key) + 1)) });
  /** Of the logarithmic axis: 1, 2, 5, 10, ... */
  const tick = (value) => ([1, 2, 5].includes(Math.round(100 * value / 10 ** Math.floor(Math.log10(value) + 1e-9)) / 100) ? number(value) : '');
  const one = addPlot({
    name: 'size', title: 'Cycles per face against mesh size,', note: data.with.length ? 'a point a view, of this run and of those given beside it.' : 'a point a view.',
    controls: [choice({ id: 'size-x', label: 'size', value: x, options: [['mesh_faces', 'faces of the initial mesh'], ['faces', 'faces that came out']], change: (to) => { x = to; one.redraw(); } })],
    make: () => ({
      type: 'scatter', columns: figures.SIZE_COLUMNS, rows,
      data: {
        datasets: names.map((name, i) => ({
          label: name, backgroundColor: PALETTE[i % PALETTE.length], pointRadius: 4,
          data: rows.filter((r) => r.mesh.replace(/(shape:[a-z]+):.*/, '$1') === name).map((r) => ({ x: r[x], y: r.cycles_per_face })),
        })),
      },
      options: { scales: { x: axis(x === 'faces' ? 'faces that came out' : 'faces of the initial mesh', { type: 'logarithmic', ...decades(x), ticks: { callback: tick, autoSkip: false } }), y: axis('cycles per face', { beginAtZero: true }) } },
    }),
  });
  return one;
}

// --- A design space -------------------------------------------------------------------------------

function designSection(exploration, index) {
  const rows = figures.designRows(exploration), parameters = figures.varied(rows);
  const front = rows.filter((r) => r.front).sort((a, b) => a.memory_bits - b.memory_bits);
  const id = (name) => `${name}-${index}`;
  const values = (p) => [...new Set(rows.map((r) => r[p]))].sort((a, b) => a - b);
  const name = (r) => parameters.map((p) => `${p} ${r[p]}`).join(', ');
  let by = parameters[0], across = parameters[0];
  const other = () => parameters.find((p) => p !== across);
  const options = parameters.map((p) => [p, p]);

  const pareto = addPlot({
    name: id('pareto'), title: 'Cycles per face against memory,', note: 'an architecture a point; the line is the Pareto front: no other is better in both.',
    controls: parameters.length ? [choice({ id: id('pareto-by'), label: 'colour', value: by, options, change: (to) => { by = to; pareto.redraw(); } })] : [],
    make: () => ({
      type: 'scatter', columns: figures.DESIGN_COLUMNS, rows,
      data: {
        datasets: [
          { type: 'line', label: 'Pareto front', data: front.map((r) => ({ x: r.memory_bits / 1e6, y: r.cycles_per_face, row: r })), ink: true, borderWidth: 1.5, pointStyle: 'line', pointRadius: 0, stepped: 'before', order: 1 },
          ...(by ? values(by) : [null]).map((value, i) => ({
            label: by ? `${by} ${value}` : 'architectures', backgroundColor: PALETTE[i % PALETTE.length], pointRadius: 5, order: 0,
            data: rows.filter((r) => !by || r[by] === value).map((r) => ({ x: r.memory_bits / 1e6, y: r.cycles_per_face, row: r })),
          })),
        ],
      },
      options: {
        plugins: { tooltip: { callbacks: { label: ({ raw }) => `${name(raw.row)}: ${number(raw.y, 2)} cycles/face, ${number(raw.x, 2)} Mbit` } } },
        scales: { x: axis('memory, Mbit', { type: 'linear', ticks: { maxTicksLimit: 7 } }), y: axis('cycles per face') },
      },
    }),
  });
  const effect = parameters.length ? addPlot({
    name: id('effect'), title: 'What a parameter does:', note: 'the fewest cycles per face, over all else that was tried.',
    controls: [choice({ id: id('effect-x'), label: 'parameter', value: across, options, change: (to) => { across = to; effect.redraw(); } })],
    make: () => {
      const series = other() ? values(other()) : [null], best = (x, s) => Math.min(...rows.filter((r) => r[across] === x && (s === null || r[other()] === s)).map((r) => r.cycles_per_face));
      const table = values(across).flatMap((x) => series.map((s) => ({ parameter: across, value: x, other: other() ?? null, other_value: s, cycles_per_face: best(x, s) })));
      return {
        type: 'line', rows: table,
        columns: [{ key: 'parameter', label: 'parameter' }, { key: 'value', label: 'value', digits: 0 }, { key: 'other', label: 'beside' }, { key: 'other_value', label: 'its value', digits: 0 }, { key: 'cycles_per_face', label: 'cycles/face', digits: 3 }],
        data: {
          labels: values(across),
          datasets: series.map((s, i) => ({ label: s === null ? across : `${other()} ${s}`, data: values(across).map((x) => best(x, s)), borderColor: PALETTE[i % PALETTE.length], backgroundColor: PALETTE[i % PALETTE.length] })),
        },
        options: { scales: { x: axis(across), y: axis('cycles per face') } },
      };
    },
  }) : null;
  const columns = figures.DESIGN_COLUMNS.filter((c) => !figures.PARAMETERS.includes(c.key) || parameters.includes(c.key));
  return [
    h('p', { class: 'soft' }, `${exploration.mesh ?? 'a mesh'}: ${number(rows.length)} architectures, by the cycle-level model.`),
    h('div', { class: 'plots' }, pareto.element, effect?.element),
    h('h3', {}, 'Architectures'), tableBox({ name: id('design'), label: 'Architectures', columns, rows, sort: 'cycles_per_face' }),
  ];
}

// --- The page -------------------------------------------------------------------------------------

function viewsSection() {
  const cycles = cyclePlot(), utilization = utilizationPlot();
  const columns = figures.VIEW_COLUMNS.map((c) => (c.key === 'verdict' ? { ...c, show: verdict } : c));
  return section('views', 'Views', cycles ? h('div', { class: 'plots' }, cycles.element, utilization?.element) : null,
    tableBox({ name: 'views', label: 'Views', columns, rows: viewRows, sort: 'view' }));
}

function pathSection() {
  const rows = figures.pathRows(run);
  if (!rows.length) return null;
  const bars = (label, key, color, sign = 1) => ({ label, data: rows.map((r) => (r[key] === null ? null : sign * r[key])), backgroundColor: color });
  const faces = addPlot({
    name: 'path', title: 'Faces from frame to frame:', note: 'kept of the frame before, gained, and, downwards, lost.',
    make: () => ({
      type: 'bar', columns: figures.PATH_COLUMNS, rows,
      data: {
        labels: rows.map((r) => r.view),
        datasets: [bars('kept', 'faces_kept', PALETTE[0]), bars('gained', 'faces_gained', PALETTE[2]), bars('lost', 'faces_lost', PALETTE[3], -1)],
      },
      options: {
        interaction: { mode: 'index' }, plugins: { tooltip: { callbacks: { label: ({ dataset, raw }) => `${dataset.label}: ${number(Math.abs(raw))}` } } },
        scales: { x: axis('frame', stacked), y: axis('faces', stacked) },
      },
    }),
  });
  const moved = total('vertices_moved', rows), compared = total('vertices_compared', rows);
  return section('path', 'Camera path',
    h('p', { class: moved ? 'warning' : 'soft' }, `Of ${number(compared)} vertices that two frames have at one level, ${moved ? number(moved) : 'none'} moved.`),
    h('div', { class: 'plots' }, faces.element),
    tableBox({ name: 'path', label: 'Camera path', columns: figures.PATH_COLUMNS, rows }));
}

function generationSection() {
  if (!views.some((view) => Array.isArray(view.generations))) return null;
  const rows = views.flatMap(figures.generationRows);
  return section('generations', 'Generations', h('div', { class: 'controls' }, viewSlider('view-generations')),
    h('div', { class: 'plots' }, generationPlots().map((p) => p.element)),
    h('p', { class: 'tools' }, 'Generations of all views: ', exports({ name: 'generations', columns: () => figures.GENERATION_COLUMNS, rows: () => rows })));
}

function sizeSection() {
  const size = sizePlot();
  return size && section('size', 'Mesh size', size.element);
}

const meshes = () => section('mesh', 'Mesh',
  h('p', { class: 'soft' }, 'What came out, and the surface as it was after each step: move the slider and see the refinement run.'),
  h('div', { class: 'controls' }, viewSlider('view-mesh')), meshSection({ meshes: data.meshes, state, size: run.settings?.size ?? [1, 1] }));

const design = () => data.explore.length && section('design', 'Design space', data.explore.map(designSection));

const timelines = () => data.timelines.length && section('timeline', 'Timeline', data.timelines.map(({ name, image }) =>
  h('figure', {}, h('img', { class: 'timeline', src: image, alt: `Timeline ${name}` }), h('figcaption', {}, name))));

const notes = () => section('notes', 'Notes',
  data.notes.length ? h('ul', {}, data.notes.map((text) => h('li', {}, text))) : h('p', { class: 'soft' }, 'Nothing is missing.'),
  h('p', {}, h('button', { type: 'button', onclick: () => download('run.json', 'application/json', JSON.stringify(run, null, 1)) }, 'run.json')));

/** A part that the data does not allow says so, and the others are there all the same. */
function attempt([id, title, make]) {
  const before = plots.length;
  try {
    return make();
  } catch (error) {
    plots.length = before;
    return section(id, title, h('p', { class: 'warning' }, `The data of this part is not as it should be: ${error.message}`));
  }
}

const all = [
  ['ran', 'What ran', whatRan], ['verdicts', 'Verdicts', verdicts], ['pictures', 'Pictures', pictures], ['mesh', 'Mesh', meshes],
  ['views', 'Views', viewsSection], ['path', 'Camera path', pathSection], ['generations', 'Generations', generationSection], ['size', 'Mesh size', sizeSection],
  ['design', 'Design space', design], ['timeline', 'Timeline', timelines], ['notes', 'Notes', notes],
].map(attempt).filter(Boolean);
listeners.push(() => plots.forEach((one) => one.redraw()));
document.getElementById('page').replaceChildren(head(),
  h('nav', { 'aria-label': 'Sections' }, h('ul', {}, all.map((s) => h('li', {}, h('a', { href: `#${s.id}` }, s.querySelector('h2').textContent))))),
  h('main', {}, all),
  h('footer', {}, 'Made by halfstep report. Libraries in this file: Chart.js, three.js, fflate; their licences stand at its beginning.'));
plots.forEach((one) => one.start());
