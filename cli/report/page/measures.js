// Verdicts, measures and conservation of one run or of several.

function verdict_section(run) {
  const {record} = run;
  const rows =
      since_of(record).map(([verdict, t]) => element('li', {}, badge(verdict), ` since ${brief(t)} s`));
  const end = {
    finished: 'finished',
    running: 'still running',
    interrupted: 'interrupted',
    failed: 'failed'
  }[record.status];
  return section(
      'Verdict',
      element(
          'p', {}, badge(record.verdict),
          ` ${end || record.status} at ${brief(record.reached)} s of ${brief(record.until)} s`),
      rows.length ? element('ul', {}, rows) : null,
      [record.reason, record.remark, record.energy_note, run.problem].filter(Boolean).map(
          (note) => element('p', {class: 'warning'}, note)),
      element(
          'div', {class: 'scroll'},
          element(
              'table', {}, element('caption', {}, 'Greatest relative drift, and indicators'),
              element('tbody', {}, drift_rows(record)))));
}

function drift_rows(record) {
  const row = (label, value) => element('tr', {}, element('th', {scope: 'row'}, label), cell(value));
  const drift = record.conservation || {}, indicators = record.indicators || {};
  return [
    row('energy', drift.energy), row('linear momentum', drift.linear_momentum ?? 'exchanged'),
    row('angular momentum', drift.angular_momentum ?? 'exchanged'),
    ...Object.entries(indicators)
        .map(([name,
               value]) => row(name, value !== null && typeof value === 'object' ? value.greatest : value))
  ];
}

function measures_section(run) {
  const measures = Object.entries(run.record.measures || {});
  if (!measures.length)
    return section('Measures', element('p', {class: 'soft'}, 'The scene has no measures.'));
  const references = [...new Set(measures.map(([, measure]) => measure.reference_name).filter(Boolean))];
  const row = ([name, measure]) => element(
      'tr', {},
      element(
          'th', {scope: 'row'}, name,
          references.length > 1 && measure.reference_name ?
              element('div', {class: 'note'}, measure.reference_name) :
              null,
          measure.why ? element('div', {class: 'note'}, measure.why) : null),
      cell(measure.value, measure.unit), cell(measure.reference, measure.unit),
      element('td', {class: 'number', title: String(measure.error ?? '')}, shown_error(measure)));
  return section(
      'Measures',
      element(
          'div', {class: 'scroll wide'},
          element(
              'table', {},
              references.length === 1 ? element('caption', {}, 'Reference: ' + references[0]) : null,
              element(
                  'thead', {},
                  element(
                      'tr', {},
                      ['measure', 'value', 'reference', 'error'].map(
                          (head, k) => element('th', {scope: 'col', class: k ? 'number' : null}, head)))),
              element('tbody', {}, measures.map(row)))));
}

/** A row for each measure, a column for each run. */
function measures_of_runs(runs) {
  const names = [...new Set(runs.flatMap((run) => Object.keys(run.record.measures || {})))];
  const row = (label, cells) => element('tr', {}, element('th', {scope: 'row'}, label), cells);
  const of_measure = (name) => {
    const all = runs.map((run) => run.record.measures?.[name]);
    const errors = all.map((one) => one?.error).filter((error) => typeof error === 'number');
    const best = errors.length > 1 ? Math.min(...errors) : null;
    const reference =
        [...new Set(all.filter(Boolean).map((one) => with_unit(one.reference, one.unit)))].join(' or ');
    return row(name, [
      ...all.map((one) => {
        if (!one) return element('td', {class: 'number'}, '–');
        return element(
            'td', {
              class: 'number' + (best !== null && one.error === best ? ' best' : ''),
              title: one.why || String(one.value)
            },
            with_unit(one.value, one.unit),
            element(
                'div', {class: 'soft'},
                typeof one.error === 'number' ? 'error ' + shown_error(one) :
                    one.why                   ? 'none' :
                                                ''));
      }),
      element('td', {class: 'number'}, reference)
    ]);
  };
  const plain = (label, value) => row(label, [...runs.map((run) => cell(value(run.record))), element('td')]);
  return section(
      'Measures of the runs',
      element(
          'div', {class: 'scroll wide whole'},
          element(
              'table', {}, element('caption', {}, 'The smallest error of each measure is bold.'),
              element(
                  'thead', {},
                  element(
                      'tr', {}, element('th', {scope: 'col'}, 'measure'),
                      runs.map(
                          (run) =>
                              element('th', {scope: 'col', class: 'number'}, run_key(run), name_of_run(run))),
                      element('th', {scope: 'col', class: 'number'}, 'reference'))),
              element(
                  'tbody', {},
                  row('verdict',
                      [
                        ...runs.map(
                            (run) => element(
                                'td', {class: 'number'}, badge(run.record.verdict),
                                since_of(run.record)
                                    .map(
                                        ([verdict, t]) => element(
                                            'div', {class: 'soft'}, `${verdict} since ${brief(t)} s`)))),
                        element('td')
                      ]),
                  names.map(of_measure), plain('energy drift', (record) => record.conservation?.energy),
                  plain('particles', (record) => record.particles),
                  plain('spacing, m', (record) => record.spacing), plain('steps', (record) => record.steps),
                  plain('solving, s', (record) => record.seconds?.solve)))));
}
