// SPDX-License-Identifier: Apache-2.0
//
// Tables that can be sorted by each column, and their rows as CSV and JSON. Where there is no room, a row becomes a card
// (style.css), whose values take their names from data-label.
import { download, h, number } from './dom.js';

const MOST_ROWS = 1000;
/** From so many columns on, a table wants all of the page's width. */
const WIDE = 9;

/** Columns: {key, label, digits}: digits of a number behind the point; without it the value is a text.
 *  `show` may be given: what is shown for a value, text or node. Rows are objects. */
export function sortedTable({ columns, rows, sort = null, label }) {
  const state = { key: sort, down: false };
  const body = h('tbody');
  const heads = columns.map((column) => {
    const button = h('button', { type: 'button', onclick: () => order(column.key) }, column.label);
    return h('th', { scope: 'col', class: column.digits === undefined ? 'text' : 'number' }, button);
  });

  function cell(column, row) {
    const value = row[column.key];
    const shown = column.show ? column.show(value, row)
      : column.digits === undefined ? String(value ?? '–') : number(value, column.digits);
    return h('td', { class: column.digits === undefined ? 'text' : 'number', 'data-label': column.label }, shown);
  }

  function compare(a, b) {
    const x = a[state.key], y = b[state.key];
    if (x === y) return 0;
    if (x === null || x === undefined) return 1; // what does not exist comes last, whichever way
    if (y === null || y === undefined) return -1;
    const less = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y), 'en', { numeric: true });
    return state.down ? -less : less;
  }

  function fill() {
    const ordered = state.key === null ? rows : [...rows].sort(compare);
    body.replaceChildren(...ordered.slice(0, MOST_ROWS).map((row) => h('tr', {}, columns.map((column) => cell(column, row)))));
    if (rows.length > MOST_ROWS)
      body.append(h('tr', {}, h('td', { colspan: columns.length }, `and ${number(rows.length - MOST_ROWS)} more, in CSV and JSON`)));
    heads.forEach((head, i) => {
      const on = columns[i].key === state.key;
      if (on) head.setAttribute('aria-sort', state.down ? 'descending' : 'ascending');
      else head.removeAttribute('aria-sort');
    });
  }

  function order(key) {
    state.down = state.key === key ? !state.down : false;
    state.key = key;
    fill();
  }

  fill();
  return h('div', { class: 'tablewrap' },
    h('table', { 'aria-label': label, class: columns.length >= WIDE ? 'wide' : null }, h('thead', {}, h('tr', {}, heads)), body));
}

function csvField(value) {
  if (value === null || value === undefined) return '';
  const text = String(value);
  // A spreadsheet would take a text that begins like this for a formula.
  const safe = typeof value === 'string' && /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

export function csvOf(columns, rows) {
  const lines = [columns.map((column) => csvField(column.key)).join(',')];
  for (const row of rows) lines.push(columns.map((column) => csvField(row[column.key])).join(','));
  return `${lines.join('\r\n')}\r\n`;
}

/** Buttons that hand out rows: CSV and JSON as files, CSV to the clipboard. */
export function exports({ name, columns, rows }) {
  const json = () => JSON.stringify(rows().map((row) => Object.fromEntries(columns().map(({ key }) => [key, row[key] ?? null]))), null, 1);
  const copy = h('button', {
    type: 'button',
    onclick: async () => {
      const text = csvOf(columns(), rows());
      try {
        await navigator.clipboard.writeText(text);
        copy.textContent = 'copied';
      } catch {
        copy.textContent = 'not allowed: use CSV';
      }
      setTimeout(() => { copy.textContent = 'copy'; }, 1500);
    },
  }, 'copy');
  return h('span', { class: 'exports' },
    h('button', { type: 'button', onclick: () => download(`${name}.csv`, 'text/csv', csvOf(columns(), rows())) }, 'CSV'),
    h('button', { type: 'button', onclick: () => download(`${name}.json`, 'application/json', json()) }, 'JSON'), copy);
}

/** A table with its exports, in a box of its own. */
export function tableBox({ name, label, columns, rows, sort }) {
  return h('div', { class: 'tablebox', id: `table-${name}` }, sortedTable({ columns, rows, sort, label }),
    h('p', { class: 'tools' }, exports({ name, columns: () => columns, rows: () => rows })));
}
