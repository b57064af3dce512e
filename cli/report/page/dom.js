// Elements, numbers and addresses. Texts of results enter the page only as text or attributes, never as HTML.

/** element("a", {href: "x", class: "y", onclick: f}, "text", child, …); null children are left out. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || (value === false && !name.startsWith('aria-'))) continue;
    if (name.startsWith('on'))
      made.addEventListener(name.slice(2), value);
    else
      made.setAttribute(name, value === true && !name.startsWith('aria-') ? '' : String(value));
  }
  made.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return made;
}

function choice(label, options, value, onchange) {
  const select = element(
      'select', {onchange: () => onchange(select.value)},
      options.map(([key, text]) => element('option', {value: key, selected: key === value}, text)));
  return element('label', {}, label, select);
}

function section(title, ...children) {
  return element('section', {'aria-label': title}, element('h2', {}, title), ...children);
}

/** At most four digits, for people. */
function brief(value) {
  if (typeof value !== 'number') return value === null || value === undefined ? '–' : String(value);
  return digits(value, 4);
}

function digits(value, count) {
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e7) return String(Number(value.toPrecision(count)));
  return value.toExponential(count - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
}

function with_unit(value, unit) {
  return brief(value) + (unit && unit !== '1' && typeof value === 'number' ? ' ' + unit : '');
}

/** An error in % of the reference, or with its unit if the reference is 0. */
function shown_error(measure) {
  if (typeof measure.error !== 'number') return '–';
  return measure.reference === 0 ? with_unit(measure.error, measure.unit) : brief(100 * measure.error) + ' %';
}

const verdicts = ['stable', 'hourglass', 'penetrated', 'fractured', 'diverged'];
const verdict_signs = {
  stable: '✓',
  hourglass: '≈',
  penetrated: '⊂',
  fractured: '✂',
  diverged: '✕'
};

function badge(verdict, text) {
  const sign = text ? '' : verdict_signs[verdict];
  return element(
      'span', {class: 'badge', 'data-verdict': verdict},
      (sign ? sign + ' ' : '') + (text || verdict || 'no verdict'));
}

function alike_badge(alike) {
  return badge(alike ? 'stable' : 'fractured', alike ? '= alike' : '≠ different');
}

/** The worst verdict comes first. */
function since_of(record) {
  return Object.entries(record.since || {})
      .filter(([, t]) => typeof t === 'number')
      .sort(([a], [b]) => verdicts.indexOf(b) - verdicts.indexOf(a));
}

function shell_word(word) {
  return /^[A-Za-z0-9_.\/=:,+@%^-]+$/.test(word) ? word : '\'' + word.replaceAll('\'', '\'\\\'\'') + '\'';
}

function cell(value, unit) {
  const number = typeof value === 'number';
  return element(
      'td', {class: number ? 'number' : null, title: number ? String(value) : null}, with_unit(value, unit));
}

function last_part(path) { return path.replace(/\/+$/, '').split('/').pop() || path; }

/** The folder's own name; its path if another run of the page has the same name. */
function name_of_run(run) {
  const runs = Object.values(taut_runs).filter((one) => last_part(one.folder) === last_part(run.folder));
  return runs.length > 1 && run.many ? run.folder : last_part(run.folder);
}
