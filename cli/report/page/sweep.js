// A sweep or a study: table, map, charts, and the run that the reader opens.

class Sweep {
  constructor(report) {
    this.report = report;
    this.rows = report.rows.map(
        (cells, index) => Object.assign(
            Object.fromEntries(report.columns.map((column, k) => [column, cells[k]])),
            {index_of_run: index}));
    this.left = this.rows;  // rows that the filter of the table leaves
    this.swept =
        report.swept.filter(({name}) => new Set(this.rows.map((row) => row['set.' + name])).size > 1);
    if (!this.swept.length) this.swept = report.swept;
    this.numeric =
        this.swept.filter(({name}) => this.rows.some((row) => typeof row['set.' + name] === 'number'));
    this.place = element('div', {class: 'stack', id: 'run'});
  }

  label(name) { return this.report.swept.find((one) => one.name === name)?.label || name; }
  /** Empty for a pure number. */
  unit_of(measure) {
    const units = this.rows.map((row) => String(row[`measures.${measure}.unit`] ?? ''));
    return units.find((unit) => unit && unit !== '1') || '';
  }

  /** Errors of a measure: all relative if any row has a relative one, else all absolute (reference 0). */
  errors_of(measure) {
    const error = (row) => row[`measures.${measure}.error`] ?? null;
    const is_relative = (row) => Boolean(row[`measures.${measure}.reference`]);
    const relative = this.rows.some((row) => error(row) !== null && is_relative(row));
    const is_other = (row) => error(row) !== null && is_relative(row) !== relative;
    return {relative, is_other, of: (row) => is_other(row) ? null : error(row)};
  }

  name_of(row) {
    return this.swept.map(({name}) => `${name}=${row['set.' + name]}`).join(', ') || row.folder;
  }
  /** Name of the series: the method and the values of all swept names except `name`. */
  series_of(row, name) {
    const method = row.method ?? '';
    const rest = this.swept.filter((one) => one.name !== name && one.name !== 'method')
                     .map((one) => `${one.name}=${row['set.' + one.name]}`);
    return [method, ...rest].join(', ');
  }

  async open(row) {
    const index = row.index_of_run;
    if (!taut_report.scripts[index] && !taut_runs[index]) return;
    const run = await load_run(index);
    const {parts} = run_parts(run, index);
    const heading = element(
        'section', {},
        element(
            'div', {class: 'bar'}, element('h2', {tabindex: -1}, 'Run ' + this.name_of(row)),
            element(
                'button', {
                  type: 'button',
                  onclick: () => {
                    this.place.replaceChildren();
                    document.onkeydown = null;
                  }
                },
                'Close')));
    show_parts(this.place, [heading, ...parts]);
    this.place.scrollIntoView({block: 'start'});
    heading.querySelector('h2').focus({preventScroll: true});
  }

  open_button(row, text, attributes = {}) {
    const there = taut_report.scripts[row.index_of_run] || taut_runs[row.index_of_run];
    return element(
        'button', {type: 'button', disabled: !there, onclick: () => this.open(row), ...attributes}, text);
  }
}

function outcome_of(row) { return ['finished', 'failed'].includes(row.status) ? row.verdict : row.status; }

function sweep_table(sweep, listen) {
  const {report} = sweep;
  const basic = new Set(['status', 'verdict']);
  const columns = [{
    key: 'index_of_run',
    label: 'run',
    shown: true,
    show: (row) =>
        sweep.open_button(row, 'Open ' + row.index_of_run, {'aria-label': 'Open run ' + sweep.name_of(row)})
  }];
  const short = (key) => key.replace(/^set\./, '')
                             .replace(/^measures\./, '')
                             .replace(/\.value$/, '')
                             .replace(/\.error$/, ' error')
                             .replace(/^since\./, 'since ')
                             .replace(/^fixed\./, '');
  for (const key of report.columns) {
    if (key === 'folder' || /\.(kind|unit|reference_name)$/.test(key) ||
        (key === 'method' && report.columns.includes('set.method')))
      continue;
    const measure = key.match(/^measures\.(.*)\.value$/)?.[1];
    const unit = measure && sweep.unit_of(measure);
    const label = key.startsWith('set.') ? sweep.label(short(key)) :
        unit                             ? short(key) + ', ' + unit :
                                           short(key);
    columns.push({
      key,
      label,
      shown: basic.has(key) || /^(set\.|measures\..*\.(value|error)$)/.test(key) || key === 'seconds.solve',
      show: key === 'verdict' ? (row) => row.verdict ? badge(row.verdict) : '–' : null
    });
  }
  return data_table('Runs', columns, sweep.rows, listen);
}

function stability_map(sweep) {
  const candidates = sweep.numeric.length ? sweep.numeric : sweep.swept.filter(({name}) => name !== 'method');
  if (!candidates.length) return null;
  let x = candidates[0].name;
  const box = element('div', {class: 'scroll map'});
  const draw = () => {
    const values = [...new Set(sweep.left.map((row) => row['set.' + x]))].sort(compare_cells);
    const series = [...new Set(sweep.left.map((row) => sweep.series_of(row, x)))];
    const others = sweep.swept.filter(({name}) => name !== x).map(({label}) => label).join(', ');
    const find = (name, value) =>
        sweep.left.find((row) => row['set.' + x] === value && sweep.series_of(row, x) === name);
    const cell_of = (row) => {
      if (!row) return element('td');
      const verdict = outcome_of(row), since = row['since.' + verdict];
      return element(
          'td', {},
          sweep.open_button(
              row,
              [
                `${verdict_signs[verdict] || '·'} ${verdict}`,
                element(
                    'small', {}, since !== null && since !== undefined ? `since ${brief(since)} s` : '\u00a0')
              ],
              {
                'data-verdict': verdict,
                'aria-label':
                    `${sweep.name_of(row)}: ${verdict}` + (since ? ` since ${brief(since)} s` : '') + ', open'
              }));
    };
    box.replaceChildren(element(
        'table', {}, element('caption', {}, 'Verdict over ' + sweep.label(x) + '. A cell opens its run.'),
        element(
            'thead', {},
            element(
                'tr', {}, element('td'),
                element('th', {scope: 'colgroup', colspan: values.length}, sweep.label(x))),
            element(
                'tr', {}, element('th', {scope: 'col'}, others),
                values.map((value) => element('th', {scope: 'col'}, brief(value))))),
        element(
            'tbody', {},
            series.map(
                (name) => element(
                    'tr', {}, element('th', {scope: 'row'}, name),
                    values.map((value) => cell_of(find(name, value))))))));
  };
  const part = section(
      'Stability map',
      candidates.length > 1 ? element(
                                  'div', {class: 'bar'},
                                  choice(
                                      'Over', candidates.map(({name, label}) => [name, label]), x,
                                      (name) => {
                                        x = name;
                                        draw();
                                      })) :
                              null,
      box);
  part.draw = draw;
  return part;
}

// marker of Chart.js and sign of the legend, by gnuplot's point type
const markers = {
  7: ['circle', '●'],
  5: ['rect', '■'],
  9: ['triangle', '▲'],
  13: ['rectRot', '◆'],
  11: ['triangle', '▼'],
  15: ['rectRounded', '▣']
};

/** Lines for Chart.js, one for each series. Unstable runs have open markers. */
function series_lines(sweep, along, point_of) {
  const groups = new Map();
  for (const row of sweep.left) {
    const point = point_of(row);
    if (!point) continue;
    const name = sweep.series_of(row, along);
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push({...point, row, open: row.verdict !== 'stable'});
  }
  const of_method = {};
  return [...groups].map(([label, points]) => {
    const method = points[0].row.method,
          style = sweep.report.styles[method] || {color: '#444444', dash: 1, marker: 7};
    const number = of_method[method] = (of_method[method] ?? -1) + 1;
    return {
      label,
      points: points.sort((a, b) => compare_cells(a.row['set.' + along], b.row['set.' + along])),
      color: style.color,
      dash: dash_patterns[1 + (style.dash - 1 + number) % 5],
      radius: 5,
      marker: markers[style.marker][0],
      sign: markers[style.marker][1],
      rotation: style.marker === 11 ? 180 : 0
    };
  });
}

function point_label(sweep) {
  return (item) => item.raw.row ?
      [sweep.name_of(item.raw.row) + ': ' + item.raw.row.verdict, `${item.raw.y} over ${item.raw.x}`] :
      item.dataset.label;
}

function line_legend(lines) {
  return element(
      'ul', {class: 'legend'}, lines.map((line) => {
        const key = element('span', {class: 'key', 'aria-hidden': 'true'});
        key.style.borderTopColor = line.color ? on_theme(line.color) : css_color('--soft');
        key.style.borderTopStyle = line.dash.length ? 'dashed' : 'solid';
        const sign = element('span', {class: 'sign', 'aria-hidden': 'true'}, line.sign || '');
        sign.style.color = key.style.borderTopColor;
        return element('li', {}, key, sign, line.label);
      }),
      lines.some((line) => line.points.some((point) => point.open)) ?
          element('li', {class: 'soft'}, 'open markers: the run was not stable') :
          null);
}

function chart_section(sweep, title, choices, lines_of, options_of, note_of = () => '') {
  const box = element('div'), legend = element('div');
  let plot = null;
  const draw = () => {
    plot?.remove();
    const lines = lines_of();
    const note = note_of();
    legend.replaceChildren(line_legend(lines), note && element('p', {class: 'soft'}, note));
    if (!lines.length) return box.replaceChildren(element('p', {class: 'soft'}, 'No run has such a value.'));
    plot = new Plot(lines, {
      tall: true,
      label: point_label(sweep),
      ...options_of(),
      open: (item, chart) => {
        const {row} = chart.data.datasets[item.datasetIndex].data[item.index];
        if (row) sweep.open(row);
      }
    });
    box.replaceChildren(plot.box);
    plot.show();
  };
  const part = section(
      title,
      element(
          'div', {class: 'bar'}, choices(draw),
          element('span', {class: 'soft'}, 'A click on a point opens its run.')),
      box, legend);
  part.draw = draw;
  theme_listeners.push(draw);
  return part;
}

function cost_chart(sweep) {
  const errors = new Map(sweep.report.measures.map((name) => [name, sweep.errors_of(name)]));
  const error_of = (row, name) => errors.get(name).of(row);
  const count = (name) => sweep.rows.filter((row) => error_of(row, name) > 0).length;
  const with_error = sweep.report.measures.filter((name) => count(name) > 1);
  if (!with_error.length) return null;
  const rank = (name) => count(name) - (name.endsWith('_time') ? 1e6 : 0);
  let measure = [...with_error].sort((a, b) => rank(b) - rank(a))[0], cost = 'seconds';
  const cost_of = (row) => cost === 'seconds' ? row['seconds.solve'] : row.particles * row.steps;
  const along = sweep.numeric.some(({name}) => name === 'spacing') ? 'spacing' : sweep.numeric[0]?.name;
  return chart_section(
      sweep, 'Error over cost',
      (draw) =>
          [choice(
               'Measure', with_error.map((name) => [name, name]), measure,
               (name) => {
                 measure = name;
                 draw();
               }),
           choice(
               'Cost', [['seconds', 'seconds of solving'], ['steps', 'particles × steps']], cost,
               (name) => {
                 cost = name;
                 draw();
               })],
      () => series_lines(
          sweep, along,
          (row) => {
            const x = cost_of(row), y = error_of(row, measure);
            return x > 0 && y > 0 ? {x, y} : null;
          }),
      () => {
        const unit = errors.get(measure).relative ? 'share of the reference' : sweep.unit_of(measure);
        return {
          x: cost === 'seconds' ? 'solving, s' : 'particles × steps',
          y: `error of ${measure}` + (unit ? ', ' + unit : ''),
          x_name: 'cost',
          x_type: 'logarithmic',
          y_type: 'logarithmic'
        };
      },
      () => {
        const others = sweep.left.filter(errors.get(measure).is_other).length;
        return others ? `Runs without a relative error, because the reference is 0: ${others}.` : '';
      });
}

/** One line for each reference, or for each series if values of a reference differ at the same x. */
function reference_lines(sweep, x, measure) {
  const shared = new Map(), own = new Map();
  const add = (lines, name, at, value) => lines.set(name, (lines.get(name) || new Map()).set(at, value));
  let all_agree = true;
  for (const row of sweep.left) {
    const at = row['set.' + x], value = row[`measures.${measure}.reference`];
    if (typeof at !== 'number' || typeof value !== 'number') continue;
    const name = row[`measures.${measure}.reference_name`] || '';
    if ((shared.get(name)?.get(at) ?? value) !== value) all_agree = false;
    add(shared, name, at, value);
    add(own, [name, sweep.series_of(row, x)].filter(Boolean).join(', '), at, value);
  }
  const line = ([name, points]) => ({
    label: name ? 'reference: ' + name : 'reference',
    radius: 4,
    marker: 'line',
    dash: [3, 3],
    width: 2,
    points: [...points].sort(([a], [b]) => a - b).map(([at, value]) => ({x: at, y: value}))
  });
  return [...(all_agree ? shared : own)].map(line);
}

function response_chart(sweep) {
  if (!sweep.numeric.length) return null;
  const quantities = [
    ...sweep.report.measures.map((name) => [`measures.${name}.value`, name]),
    ...sweep.report.columns.filter((key) => /^indicators\..*\.greatest$/.test(key))
        .map((key) => [key, 'greatest ' + key.split('.')[1]]),
    ['conservation.energy', 'energy drift'], ['seconds.solve', 'seconds of solving']
  ].filter(([key]) => sweep.rows.some((row) => typeof row[key] === 'number'));
  if (!quantities.length) return null;
  let x = sweep.numeric[0].name, y = quantities[0][0];
  return chart_section(
      sweep, 'Response',
      (draw) =>
          [choice(
               'Of', quantities, y,
               (key) => {
                 y = key;
                 draw();
               }),
           choice(
               'Over', sweep.numeric.map(({name, label}) => [name, label]), x,
               (name) => {
                 x = name;
                 draw();
               })],
      () => {
        const lines = series_lines(
            sweep, x,
            (row) => typeof row[y] === 'number' && typeof row['set.' + x] === 'number' ?
                {x: row['set.' + x], y: row[y]} :
                null);
        const measure = y.match(/^measures\.(.*)\.value$/)?.[1];
        if (measure) lines.push(...reference_lines(sweep, x, measure));
        return lines;
      },
      () => {
        const unit = y.startsWith('measures.') ? sweep.unit_of(y.split('.')[1]) : '';
        const name = quantities.find(([key]) => key === y)[1];
        return {x: sweep.label(x), y: name + (unit ? ', ' + unit : ''), x_name: x};
      });
}

function study_pictures(report) {
  if (!report.pictures.length) return null;
  return section(
      'Pictures of the study',
      element(
          'div', {class: 'pictures'},
          report.pictures.map(
              ({name, src}) => element(
                  'figure', {}, element('figcaption', {}, name),
                  element(
                      'a', {href: src}, element('img', {src, alt: 'Picture ' + name, loading: 'lazy'}))))));
}

function show_sweep(report) {
  const sweep = new Sweep(report);
  const fixed = Object.entries(report.fixed).map(([name, value]) => `${name} = ${value}`).join(', ');
  const counts =
      verdicts.map((verdict) => [verdict, sweep.rows.filter((row) => outcome_of(row) === verdict).length])
          .filter(([, n]) => n);
  show_head(
      report.title, `${sweep.rows.length} runs of ${report.scene}` + (fixed ? `, all with ${fixed}` : ''),
      element('span', {}, counts.map(([verdict, n]) => [badge(verdict, `${n} ${verdict}`), ' '])));
  const charts = [stability_map(sweep), cost_chart(sweep), response_chart(sweep)].filter(Boolean);
  const table = sweep_table(sweep, (left) => {
    sweep.left = left;
    for (const chart of charts) chart.draw();
  });
  return [table, ...charts, study_pictures(report), sweep.place];
}
