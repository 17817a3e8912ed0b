// SPDX-License-Identifier: Apache-2.0
//
// Elements from code. Text goes in as text, never as HTML.

/** An element: properties that begin with "on" are listeners, others attributes (true: without a value; null and
 *  false: none). Children are nodes, texts, or lists of such. */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** A number as people read it: thousands apart, `digits` behind the point; a dash for what does not exist. */
export function number(value, digits = 0) {
  if (typeof value !== 'number' || !Number.isFinite(value)) return '–';
  return value.toLocaleString('en', { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

/** A slider over 0 .. count-1 with its value in words beside it. */
export function slider({ id, label, count, value = 0, words, change }) {
  const output = h('output', { for: id }, words(value));
  const input = h('input', {
    id, type: 'range', min: 0, max: Math.max(count - 1, 0), step: 1, value, disabled: count < 2,
    oninput: () => { output.textContent = words(Number(input.value)); change(Number(input.value)); },
  });
  const set = (to) => { input.value = to; output.textContent = words(Number(input.value)); };
  const limit = (size) => { input.max = Math.max(size - 1, 0); input.disabled = size < 2; };
  return { element: h('div', { class: 'slider' }, h('label', { for: id }, label), input, output), set, limit, input };
}

/** A choice: options are [value, words]. */
export function choice({ id, label, options, value, change }) {
  const select = h('select', { id, onchange: () => change(select.value) },
    options.map(([name, words]) => h('option', { value: name, selected: name === value }, words)));
  return h('div', { class: 'choice' }, h('label', { for: id }, label), select);
}

/** Hands text to the person as a file. */
export function download(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
