// SPDX-License-Identifier: Apache-2.0
//
// What the plots and tables show, from run.json and explore.json: columns and rows, without a page. docs/command-line.md
// and docs/explore.md say what the keys mean. Anything may be missing: then it is null here.

export const STAGES = ['receive', 'transform', 'quantize', 'classify', 'select', 'guard', 'smooth', 'split', 'emit'];
export const ACTIVITIES = ['busy', 'starved', 'blocked', 'idle'];
/** The stages whose passes follow one another; the others work beside them. */
export const PASSES = ['classify', 'select', 'guard', 'smooth', 'split'];

const list = (value) => (Array.isArray(value) ? value : []);
const sum = (values) => values.reduce((a, b) => a + (b ?? 0), 0);
const ratio = (a, b) => (typeof a === 'number' && b ? a / b : null);

/** The engine whose cycles count: rtl, or without it model. */
export const timedEngine = (view) => (view.engines?.rtl ? 'rtl' : view.engines?.model ? 'model' : null);
const outEngine = (view) => timedEngine(view) ?? Object.keys(view.engines ?? {})[0];

// --- A run ----------------------------------------------------------------------------------------

export const VIEW_COLUMNS = [
  { key: 'view', label: 'view', digits: 0 }, { key: 'status', label: 'status' },
  { key: 'faces', label: 'faces', digits: 0 }, { key: 'vertices', label: 'vertices', digits: 0 },
  { key: 'triangles', label: 'triangles', digits: 0 }, { key: 'cycles', label: 'cycles', digits: 0 },
  { key: 'cycles_per_face', label: 'cycles/face', digits: 2 }, { key: 'bound', label: 'bound', digits: 0 },
  { key: 'ratio', label: 'ratio', digits: 3 }, { key: 'first_face', label: 'first face', digits: 0 },
  { key: 'conflicts', label: 'conflicts', digits: 0 }, { key: 'khz', label: 'kHz simulated', digits: 0 },
  { key: 'verdict', label: 'verdict' },
];

export function viewRows(run) {
  return list(run.views).map((view) => {
    const engine = view.engines[outEngine(view)] ?? {};
    return {
      view: view.view, status: engine.status ?? null, faces: engine.faces ?? null, vertices: engine.vertices ?? null,
      triangles: engine.triangles ?? null, cycles: engine.cycles ?? null, cycles_per_face: ratio(engine.cycles, engine.faces),
      bound: view.bound ?? null, ratio: ratio(engine.cycles, view.bound), first_face: engine.first_face ?? null,
      conflicts: engine.conflicts ?? null, khz: engine.seconds ? ratio(engine.cycles, 1000 * engine.seconds) : null,
      verdict: verdictOf(view),
    };
  });
}

const holds = (comparison) => comparison.compared > 0 && comparison.different === 0;

function verdictOf(view) {
  const all = list(view.comparisons);
  if (!all.length) return 'nothing compared';
  return all.every(holds) ? 'equal' : 'DIFFER';
}

export const COMPARISON_COLUMNS = [
  { key: 'a', label: 'one' }, { key: 'b', label: 'the other' }, { key: 'what', label: 'what' },
  { key: 'views', label: 'views', digits: 0 }, { key: 'compared', label: 'compared', digits: 0 },
  { key: 'different', label: 'different', digits: 0 }, { key: 'verdict', label: 'verdict' },
];

/** All views together: a row per pair and thing. */
export function comparisonRows(run) {
  const rows = new Map();
  for (const view of list(run.views)) {
    const counted = new Set(); // several pictures are compared of a view
    for (const c of list(view.comparisons)) {
      const key = `${c.a} ${c.b} ${c.what}`;
      const row = rows.get(key) ?? { a: c.a, b: c.b, what: c.what, views: 0, compared: 0, different: 0, verdict: 'equal' };
      if (!counted.has(key)) row.views++;
      counted.add(key);
      row.compared += c.compared;
      row.different += c.different;
      if (!holds(c)) row.verdict = 'DIFFER';
      rows.set(key, row);
    }
  }
  return [...rows.values()];
}

export const PICTURE_COLUMNS = [
  { key: 'view', label: 'view', digits: 0 }, { key: 'a', label: 'one' }, { key: 'b', label: 'the other' }, { key: 'what', label: 'picture' },
  { key: 'pixels', label: 'pixels', digits: 0 }, { key: 'different', label: 'different', digits: 0 }, { key: 'visible', label: 'visibly', digits: 0 },
  { key: 'psnr', label: 'PSNR, dB', digits: 1 }, { key: 'silhouette_mean', label: 'silhouette, mean', digits: 3 },
  { key: 'silhouette_maximum', label: 'maximum, pixels', digits: 2 },
];

export const pictureRows = (run) =>
  list(run.views).flatMap((view) => list(view.pictures?.comparisons).map((c) => ({ view: view.view, ...c })));

/** Cycles of each stage at work (not idle), per view. */
export const CYCLE_COLUMNS = [
  { key: 'view', label: 'view', digits: 0 }, ...STAGES.map((key) => ({ key, label: key, digits: 0 })),
  { key: 'cycles', label: 'cycles', digits: 0 }, { key: 'bound', label: 'bound', digits: 0 },
];

export function cycleRows(run) {
  return list(run.views).flatMap((view) => {
    const engine = view.engines[timedEngine(view)];
    if (!engine?.stages) return [];
    const row = { view: view.view };
    for (const stage of STAGES) {
      const s = engine.stages[stage] ?? {};
      row[stage] = sum([s.busy, s.starved, s.blocked]);
    }
    return [{ ...row, cycles: engine.cycles, bound: view.bound ?? null }];
  });
}

export const PATH_COLUMNS = [
  { key: 'view', label: 'frame', digits: 0 }, { key: 'faces', label: 'faces', digits: 0 },
  { key: 'faces_kept', label: 'kept', digits: 0 }, { key: 'faces_gained', label: 'gained', digits: 0 },
  { key: 'faces_lost', label: 'lost', digits: 0 }, { key: 'vertices_shared', label: 'shared vertices', digits: 0 },
  { key: 'vertices_compared', label: 'compared', digits: 0 }, { key: 'vertices_moved', label: 'moved', digits: 0 },
  { key: 'silhouette_share', label: 'silhouette, %', digits: 2 },
];

/** Of a camera path: each frame beside the one before it. Empty if the run's views are no path. */
export function pathRows(run) {
  return list(run.views).filter((view) => view.path !== undefined).map((view) => {
    const row = { view: view.view, faces: view.engines[outEngine(view)]?.faces ?? null };
    for (const { key } of PATH_COLUMNS) if (!(key in row)) row[key] = view.path?.[key] ?? null;
    if (row.silhouette_share !== null) row.silhouette_share *= 100;
    return row;
  });
}

export const GENERATION_COLUMNS = [
  { key: 'view', label: 'view', digits: 0 }, { key: 'generation', label: 'generation', digits: 0 },
  { key: 'active', label: 'active', digits: 0 }, { key: 'selected', label: 'selected', digits: 0 },
  { key: 'refined', label: 'refined', digits: 0 }, { key: 'final', label: 'left', digits: 0 },
  { key: 'vertices', label: 'vertices', digits: 0 }, { key: 'moved', label: 'moved', digits: 0 },
  { key: 'cycle', label: 'begins', digits: 0 }, { key: 'cycles', label: 'cycles', digits: 0 },
];

/** A generation ends where the next one begins, the last one that the sequencer turned to with the view: the faces of
 *  the last step leave while it is made. */
export function generationRows(view) {
  const generations = list(view.generations), total = view.engines?.model?.cycles ?? null;
  return generations.map((g, i) => {
    const begin = g.cycle ?? null, end = generations[i + 1]?.cycle ?? total;
    return { view: view.view, generation: i, ...g, cycle: begin, cycles: begin !== null && end !== null ? end - begin : null };
  });
}

export const UTILIZATION_COLUMNS = [
  { key: 'view', label: 'view' }, { key: 'stage', label: 'stage' },
  ...ACTIVITIES.map((key) => ({ key, label: key, digits: 0 })), { key: 'items', label: 'items', digits: 0 },
  { key: 'bound', label: 'bound', digits: 0 }, { key: 'busy_share', label: 'busy, %', digits: 1 },
];

/** Of one view, or of all together (view: null). */
export function utilizationRows(run, number) {
  const views = list(run.views).filter((view) => number === null || view.view === number);
  return STAGES.flatMap((stage) => {
    const all = views.map((view) => view.engines[timedEngine(view)]?.stages?.[stage]).filter(Boolean);
    if (!all.length) return [];
    const row = { view: number === null ? 'all' : String(number), stage };
    for (const key of [...ACTIVITIES, 'items', 'bound']) row[key] = sum(all.map((s) => s[key]));
    return [{ ...row, busy_share: 100 * (ratio(row.busy, sum(ACTIVITIES.map((a) => row[a]))) ?? 0) }];
  });
}

export const SIZE_COLUMNS = [
  { key: 'mesh', label: 'mesh' }, { key: 'view', label: 'view', digits: 0 }, { key: 'mesh_faces', label: 'faces in', digits: 0 },
  { key: 'faces', label: 'faces out', digits: 0 }, { key: 'cycles', label: 'cycles', digits: 0 },
  { key: 'cycles_per_face', label: 'cycles/face', digits: 3 }, { key: 'ratio', label: 'ratio', digits: 3 },
];

export function sizeRows(runs) {
  return runs.flatMap((run) => viewRows(run)
    .filter((row) => row.cycles_per_face !== null)
    .map(({ view, faces, cycles, cycles_per_face, ratio: over }) =>
      ({ mesh: run.mesh?.source ?? '?', view, mesh_faces: run.mesh?.faces ?? null, faces, cycles, cycles_per_face, ratio: over })));
}

// --- An exploration -------------------------------------------------------------------------------

export const PARAMETERS = ['port', 'banks', 'window', 'lanes', 'latency', 'ops', 'views', 'parity'];

export const DESIGN_COLUMNS = [
  ...PARAMETERS.map((key) => ({ key, label: key, digits: 0 })),
  { key: 'cycles', label: 'cycles', digits: 0 }, { key: 'faces', label: 'faces', digits: 0 },
  { key: 'cycles_per_face', label: 'cycles/face', digits: 3 }, { key: 'ratio', label: 'ratio', digits: 3 },
  { key: 'memory_bits', label: 'memory bits', digits: 0 }, { key: 'bytes_read_per_face', label: 'read, B/face', digits: 1 },
  { key: 'bytes_written_per_face', label: 'written, B/face', digits: 1 }, { key: 'front', label: 'Pareto front' },
];

/** A row an architecture, its views together: the cycles of the whole row of views over all their faces. front is
 *  "yes" where no other is better in both cycles per face and memory. */
export function designRows(exploration) {
  const rows = new Map();
  for (const point of list(exploration.points)) {
    const set = point.set ?? {}, key = JSON.stringify(PARAMETERS.map((p) => set[p]));
    const row = rows.get(key) ?? {
      ...Object.fromEntries(PARAMETERS.map((p) => [p, set[p] ?? null])), cycles: point.stream_cycles, faces: 0, bound: 0,
      memory_bits: point.memory_bits, read: 0, written: 0,
    };
    row.faces += point.faces;
    row.bound += point.bound;
    row.read += point.bytes_read_per_face * point.faces;
    row.written += point.bytes_written_per_face * point.faces;
    rows.set(key, row);
  }
  const all = [...rows.values()].map(({ read, written, bound, ...row }) => ({
    ...row, cycles_per_face: ratio(row.cycles, row.faces), ratio: ratio(row.cycles * (row.views ?? 1), bound),
    bytes_read_per_face: ratio(read, row.faces), bytes_written_per_face: ratio(written, row.faces),
  }));
  for (const row of all) {
    const beaten = all.some((o) => o.cycles_per_face <= row.cycles_per_face && o.memory_bits <= row.memory_bits
      && (o.cycles_per_face < row.cycles_per_face || o.memory_bits < row.memory_bits));
    row.front = beaten ? '' : 'yes';
  }
  return all;
}

/** The parameters that have more than one value among rows. */
export const varied = (rows) => PARAMETERS.filter((p) => new Set(rows.map((row) => row[p])).size > 1);
