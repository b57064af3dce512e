// Columns of the history.csv of runs: a plot for each chosen column, all with the same range of x.

function column_of(run, name) { return run.history?.columns.find((column) => column.name === name); }

function points_of(run, x, y) {
  const along = column_of(run, x), values = column_of(run, y);
  if (!along || !values) return [];
  return values.values.map((value, k) => ({x: along.values[k], y: value}))
      .filter((point) => point.x !== null);
}

function history_lines(runs, x, y) {
  const lines = runs.filter((run) => column_of(run, y)).map((run) => ({
                                                              label: run.many ? name_of_run(run) : y,
                                                              points: points_of(run, x, y),
                                                              color: run.style.color,
                                                              dash: dash_of(run.style)
                                                            }));
  if (x !== 't') return lines;
  const names = new Set();
  for (const run of runs)
    for (const curve of run.references) {
      if (curve.column !== y || names.has(curve.name)) continue;
      names.add(curve.name);
      const last = column_of(run, 't')?.values.at(-1) ?? Infinity;
      lines.push({
        label: 'reference: ' + curve.name,
        dash: [3, 3],
        width: 3,
        points: curve.t.map((t, k) => ({x: t, y: curve.values[k]})).filter((point) => point.x <= last)
      });
    }
  return lines;
}

/** The first six probes: columns between the momenta and `pieces`. Without probes, the total energy. */
function default_columns(names) {
  const first = names.findLastIndex((name) => /^(angular_)?momentum/.test(name)) + 1,
        last = names.indexOf('pieces');
  const probes = names.slice(first, last < 0 ? names.length : last);
  return probes.length ? probes.slice(0, 6) : names.filter((name) => name === 'total_energy');
}

let kept_columns = null;  // the reader's choice

function histories(runs, clock) {
  const shown = runs.filter((run) => run.history?.columns[0]?.values.length);
  if (!shown.length) return null;
  const names = [...new Set(shown.flatMap((run) => run.history.columns.map((column) => column.name)))];
  const chosen = new Set(
      (kept_columns || shown.flatMap((run) => default_columns(run.history.columns.map(({name}) => name))))
          .filter((name) => names.includes(name)));
  const unit =
      (name) => [...new Set(shown.map((run) => column_of(run, name)?.unit).filter(Boolean))].join(' or ');
  const title = (name) => name + (unit(name) ? ', ' + unit(name) : '');
  const box = element('div', {class: 'plots'});
  let plots = [], x = 't', range = null;

  const zoom = (to) => {
    range = to;
    for (const plot of plots) plot.zoom(range);
  };
  const draw = () => {
    for (const plot of plots) plot.remove();
    plots = names.filter((name) => chosen.has(name)).map((name) => new Plot(history_lines(shown, x, name), {
                                                           title: title(name),
                                                           x: title(x),
                                                           y: title(name),
                                                           x_name: x,
                                                           x_unit: unit(x),
                                                           y_unit: unit(name),
                                                           sorted: x === 't',
                                                           zoomed: zoom,
                                                           picked: x === 't' ? (t) => clock.go_near(t) : null
                                                         }));
    box.replaceChildren(...plots.map((plot) => plot.box));
    for (const plot of plots) plot.show();
    zoom(null);
    move();
  };
  const move = () => {
    if (x === 't')
      for (const plot of plots) plot.set_cursor(clock.time);
  };
  const nearer = (factor) => () => {
    const all = plots[0]?.chart.scales.x;
    if (!all) return;
    const middle = x === 't' ? Math.min(Math.max(clock.time, all.min), all.max) : (all.min + all.max) / 2;
    zoom([middle - (middle - all.min) * factor, middle + (all.max - middle) * factor]);
  };
  const check = (name) => element(
      'label', {}, element('input', {
        type: 'checkbox',
        checked: chosen.has(name),
        value: name,
        onchange: (event) => {
          event.target.checked ? chosen.add(name) : chosen.delete(name);
          kept_columns = [...chosen];
          draw();
        }
      }),
      ' ' + name);
  const thinned = Math.max(...shown.map((run) => run.history.every));
  const part = section(
      'Histories',
      element(
          'div', {class: 'bar'},
          choice(
              'Over', names.map((name) => [name, title(name)]), x,
              (name) => {
                x = name;
                draw();
              }),
          element('button', {type: 'button', onclick: nearer(0.5)}, 'Zoom in'),
          element('button', {type: 'button', onclick: nearer(2)}, 'Zoom out'),
          element('button', {type: 'button', onclick: () => zoom(null)}, 'Whole run'),
          element('span', {class: 'soft'}, 'Drag across a plot to zoom, click to go to a time.')),
      element(
          'details', {}, element('summary', {}, 'Columns'),
          element(
              'div', {class: 'choice', role: 'group', 'aria-label': 'Columns to plot'},
              names.filter((name) => name !== 't').map(check))),
      history_legend(shown), box,
      thinned > 1 ? element('p', {class: 'soft'}, `One row in ${thinned} of history.csv is plotted.`) :
                    null);
  part.later = () => {
    draw();
    clock.listen(move);
  };
  return part;
}

function history_legend(runs) {
  const reference = runs.some((run) => run.references.length);
  if (!reference && runs.length === 1) return null;
  const dashed = element('span', {class: 'key', 'aria-hidden': 'true', style: 'border-top-style: dotted'});
  return element(
      'ul', {class: 'legend'},
      runs.map(
          (run) => element(
              'li', {}, run.many ? run_key({...run, many: true}) : null, run.many ? name_of_run(run) : null)),
      reference ? element('li', {}, dashed, 'reference of the scene') : null);
}
