// A table that can be sorted and filtered.

/** Words that must all match: "seconds.solve<10", "method!=og" or a text in any cell. A column is named by its label, the
    beginning of its label, or its key. */
function filter_of(words, columns) {
  const tests = words.trim().split(/\s+/).filter(Boolean).map((word) => {
    const [, name, sign, value] = word.match(/^(.+?)(<=|>=|!=|<|>|=)(.*)$/) || [];
    const column = columns.find((one) => one.label === name || one.key === name) ||
        columns.find((one) => name && one.label.startsWith(name));
    if (!column)
      return (row) =>
                 columns.some((one) => String(row[one.key] ?? '').toLowerCase().includes(word.toLowerCase()));
    const bound = Number(value);
    return (row) => {
      const is = row[column.key];
      if (sign === '=') return String(is) === value || (value !== '' && is === bound);
      if (sign === '!=') return String(is) !== value && is !== bound;
      if (typeof is !== 'number') return false;
      return {'<': is < bound, '<=': is <= bound, '>': is > bound, '>=': is >= bound}[sign];
    };
  });
  return (row) => tests.every((test) => test(row));
}

function compare_cells(a, b) {
  const missing = (value) => value === null || value === undefined;
  if (missing(a) || missing(b)) return missing(a) - missing(b);
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a).localeCompare(String(b), 'en', {numeric: true});
}

/** `columns`: {key, label, shown (at first), show(row) → node or null}; `rows`: objects by key. `listen` gets the rows that
    the filter leaves. */
function data_table(title, columns, rows, listen) {
  let sorted_by = null, ascending = true;
  const chosen = new Set(columns.filter((column) => column.shown).map((column) => column.key));
  const box = element('div', {class: 'scroll wide'}),
        count = element('output', {class: 'soft', role: 'status'});
  const search = element('input', {
    type: 'search',
    size: 34,
    placeholder: 'verdict=stable seconds.solve<10',
    oninput: () => draw(),
    'aria-label': 'Filter: words, or COLUMN=VALUE, COLUMN<NUMBER'
  });

  const head = (column) => element(
      'th', {
        scope: 'col',
        class: rows.some((row) => typeof row[column.key] === 'number') ? 'number' : null,
        'aria-sort': sorted_by === column.key ? (ascending ? 'ascending' : 'descending') : 'none'
      },
      element(
          'button', {
            type: 'button',
            'data-key': column.key,
            onclick: () => {
              ascending = sorted_by === column.key ? !ascending : true;
              sorted_by = column.key;
              draw();
              box.querySelector(`button[data-key="${CSS.escape(column.key)}"]`)?.focus();
            }
          },
          column.label + (sorted_by === column.key ? (ascending ? ' ▲' : ' ▼') : '')));
  const draw = () => {
    const left = rows.filter(filter_of(search.value, columns));
    if (sorted_by !== null) {
      const missing = (row) => row[sorted_by] === null || row[sorted_by] === undefined;
      left.sort(
          (a, b) => missing(a) || missing(b) ?
              missing(a) - missing(b) :
              (ascending ? 1 : -1) * compare_cells(a[sorted_by], b[sorted_by]));
    }
    const visible = columns.filter((column) => chosen.has(column.key));
    box.replaceChildren(element(
        'table', {}, element('thead', {}, element('tr', {}, visible.map(head))),
        element(
            'tbody', {},
            left.map(
                (row) => element(
                    'tr', {},
                    visible.map(
                        (column) =>
                            column.show ? element('td', {}, column.show(row)) : cell(row[column.key])))))));
    count.textContent = `${left.length} of ${rows.length} runs`;
    listen?.(left);
  };
  const check = (column) => element(
      'label', {}, element('input', {
        type: 'checkbox',
        checked: chosen.has(column.key),
        onchange: (event) => {
          event.target.checked ? chosen.add(column.key) : chosen.delete(column.key);
          draw();
        }
      }),
      ' ' + column.label);
  const part = section(
      title, element('div', {class: 'bar'}, element('label', {}, 'Filter ', search), count),
      element(
          'details', {}, element('summary', {}, 'Columns'),
          element('div', {class: 'choice'}, columns.map(check))),
      box);
  part.ready = draw;
  return part;
}
