// SPDX-License-Identifier: Apache-2.0
//
// Plots by Chart.js in the page's colours, each with its numbers beside it.
import {
  BarController, BarElement, CategoryScale, Chart, Legend, LinearScale, LineController, LineElement,
  LogarithmicScale, PointElement, ScatterController, Tooltip,
} from 'chart.js';
import { h } from './dom.js';
import { exports, sortedTable } from './table.js';

Chart.register(BarController, BarElement, CategoryScale, Legend, LinearScale, LineController, LineElement,
  LogarithmicScale, PointElement, ScatterController, Tooltip);
Chart.defaults.animation = false;
Chart.defaults.responsive = true;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.font.family = 'system-ui, sans-serif';

const dark = window.matchMedia('(prefers-color-scheme: dark)');
let printing = false;
const charts = [];

/** Distinct colours that people with any colour vision tell apart by lightness as well, in either theme. */
export const PALETTE = ['#4477aa', '#ee9944', '#228866', '#cc4466', '#66bbdd', '#ccbb44', '#775599', '#99aa88', '#aa6644', '#7788ff'];
export const ACTIVITY = { busy: '#3d7fbf', starved: '#e3b341', blocked: '#cf4b4b', idle: '#9aa3ad' };

function ink() {
  const light = printing || !dark.matches;
  return light ? { text: '#2a333c', grid: '#dde2e7', line: '#11181f' } : { text: '#c9d1d9', grid: '#313a44', line: '#f2f5f8' };
}

/** Colours go into the options as they were made: what a chart gives back of them are its own views on them. */
function paint({ chart, made }) {
  const { text, grid, line } = ink();
  for (const scale of Object.values(made.options.scales)) {
    scale.ticks = { ...scale.ticks, color: text };
    scale.grid = { ...scale.grid, color: grid };
    if (scale.title) scale.title.color = text;
  }
  made.data.datasets.forEach((set) => {
    set.pointStyle ??= (set.type ?? made.type) === 'bar' ? 'rect' : 'circle';
    if (set.ink) set.borderColor = set.backgroundColor = line;
  });
  chart.data = made.data;
  chart.options = {
    ...made.options, color: text,
    plugins: { legend: { position: 'bottom', labels: { boxWidth: 22, boxHeight: 9, usePointStyle: true, color: text } }, ...made.options.plugins },
  };
  chart.update('none');
}

const repaint = () => charts.forEach(paint);
dark.addEventListener('change', repaint);
window.addEventListener('beforeprint', () => { printing = true; charts.forEach((one) => { one.chart.resize(); paint(one); }); });
window.addEventListener('afterprint', () => { printing = false; charts.forEach((one) => { one.chart.resize(); paint(one); }); });

export const axis = (title, more = {}) => ({ title: { display: true, text: title }, ...more });

/** A figure: `make()` gives {type, data, options, columns, rows}; redraw() asks it again. */
export function plot({ name, title, note, make, controls = [] }) {
  const canvas = h('canvas', { id: `plot-${name}`, role: 'img', 'aria-label': title });
  const numbers = h('div');
  const details = h('details', {}, h('summary', {}, 'numbers'), numbers);
  let chart = null, made = make();
  const fill = () => { if (details.open) numbers.replaceChildren(sortedTable({ columns: made.columns, rows: made.rows, label: title })); };
  details.addEventListener('toggle', fill);
  const figure = h('figure', { class: 'plot' },
    h('figcaption', {}, h('strong', {}, title), note ? h('span', {}, ` ${note}`) : null),
    controls.length ? h('div', { class: 'controls' }, controls) : null,
    h('div', { class: 'chart' }, canvas),
    h('div', { class: 'tools' }, exports({ name, columns: () => made.columns, rows: () => made.rows }), details));
  const entry = { get made() { return made; }, get chart() { return chart; } };
  return {
    element: figure,
    /** Once the figure is in the page, which gives it its size. */
    start() {
      chart = new Chart(canvas, { type: made.type, data: { datasets: [] } });
      charts.push(entry);
      paint(entry);
    },
    redraw() {
      made = make();
      fill();
      if (chart) paint(entry);
    },
  };
}
