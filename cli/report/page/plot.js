// A plot by Chart.js, with zooming by dragging, a line at the time of the clock, and a text description.

Chart.defaults.animation = false;
Chart.defaults.font.family = 'system-ui, \'DejaVu Sans\', sans-serif';

// the nearest point of each line
Chart.Interaction.modes.nearest_of_each = (chart, event) => {
  const x = chart.scales.x.getValueForPixel(event.x);
  return chart.getSortedVisibleDatasetMetas()
      .map((meta) => {
        const points = chart.data.datasets[meta.index].data;
        let low = 0, high = points.length - 1;
        while (high - low > 1) {
          const middle = (low + high) >> 1;
          if (points[middle].x <= x)
            low = middle;
          else
            high = middle;
        }
        const index = high >= 0 && Math.abs(points[high].x - x) < Math.abs(points[low].x - x) ? high : low;
        return {element: meta.data[index], datasetIndex: meta.index, index};
      })
      .filter((item) => item.element);
};

class Plot {
  /** `lines`: {label, points: [{x, y, …}], color, …}; `options`: x, y: axis titles; sorted: points ascend in x; … */
  constructor(lines, options) {
    this.options = options;
    this.canvas = element('canvas', {role: 'img', tabindex: 0, 'aria-label': this.description(lines)});
    this.readout = element('output', {'aria-live': 'off'});
    this.canvas.plot = this;
    this.frame = element('div', {class: 'canvas'}, this.canvas);
    this.box = element(
        'div', {class: 'plot' + (options.tall ? ' tall' : '')},
        options.title ? element('h3', {}, options.title) : null, this.frame, this.readout);
    this.lines = lines;
    theme_listeners.push(() => this.paint());
  }

  description(lines) {
    return `Plot of ${this.options.y} over ${this.options.x}: ` + lines.map((line) => line.label).join(', ');
  }

  /** Requires the canvas in the page. */
  show() {
    this.chart =
        new Chart(this.canvas, {type: 'scatter', data: {datasets: []}, options: this.chart_options()});
    this.paint();
    this.take_pointer();
    return this;
  }

  chart_options() {
    const {options} = this;
    const axis = (title, type, coordinate) => ({
      ...(type === 'logarithmic' ? this.log_range(coordinate) : {}),
      type: type || 'linear',
      title: {display: true, text: title},
      ticks: {maxRotation: 0, callback: type === 'logarithmic' ? log_tick : linear_tick}
    });
    return {
      responsive: true,
      maintainAspectRatio: false,
      parsing: false,
      normalized: Boolean(options.sorted),
      interaction: {mode: options.sorted ? 'nearest_of_each' : 'nearest', intersect: false},
      scales: {
        x: {...axis(options.x, options.x_type, 'x'), bounds: options.sorted ? 'data' : 'ticks'},
        y: axis(options.y, options.y_type, 'y')
      },
      onClick: (event, items) => {
        if (items.length && options.open) options.open(items[0], this.chart);
      },
      plugins: {
        legend: {display: false},
        tooltip: {
          callbacks: {
            title: (items) => items.length && options.sorted ?
                `${options.x_name} = ${items[0].raw.x}${unit_text(options.x_unit)}` :
                '',
            label: (item) => options.label ?
                options.label(item) :
                `${item.dataset.label}: ${item.raw.y}${unit_text(options.y_unit)}` +
                    (options.sorted ? '' : ` at ${options.x_name} = ${item.raw.x}`)
          }
        }
      }
    };
  }

  /** Chart.js would begin and end at powers of ten. */
  log_range(coordinate) {
    const all = this.lines.flatMap((line) => line.points.map((point) => point[coordinate]));
    return {min: Math.min(...all) / 1.3, max: Math.max(...all) * 1.3};
  }

  paint() {
    if (!this.chart) return;
    const text = css_color('--text'), line = css_color('--line');
    for (const scale of Object.values(this.chart.options.scales)) {
      scale.ticks.color = text;
      scale.title.color = text;
      scale.grid = {color: line, borderColor: line};
    }
    this.chart.data.datasets =
        this.lines.map((one) => ({
                         label: one.label,
                         data: one.points,
                         showLine: one.line !== false,
                         borderWidth: one.width || 1.8,
                         borderColor: one.color ? on_theme(one.color) : css_color('--soft'),
                         borderDash: one.dash || [],
                         pointRadius: one.radius || 0,
                         pointHoverRadius: (one.radius || 2) + 2,
                         pointStyle: one.marker,
                         pointRotation: one.rotation || 0,
                         pointBackgroundColor: one.points.map(
                             (point) => point.open ? css_color('--card') :
                                 one.color         ? on_theme(one.color) :
                                                     css_color('--soft')),
                         pointBorderWidth: one.radius ? 2 : 0,
                         spanGaps: false
                       }));
    this.chart.update();
    this.draw_cursor();
  }

  set_lines(lines) {
    this.lines = lines;
    this.canvas.setAttribute('aria-label', this.description(lines));
    this.paint();
  }

  /** Shows the values at time `x` below the plot, and a line at `x`. */
  set_cursor(x) {
    this.cursor_at = x;
    this.readout.textContent = `at ${this.options.x_name} = ${brief(x)}${unit_text(this.options.x_unit)}: ` +
        this.lines.map((line) => `${line.label} ${brief(value_near(line.points, x))}`).join('; ');
    this.draw_cursor();
  }

  draw_cursor() {
    if (this.cursor_at === undefined || !this.chart) return;
    this.cursor ??= this.frame.appendChild(element('div', {class: 'cursor'}));
    const {chartArea, scales} = this.chart;
    const x = scales.x.getPixelForValue(this.cursor_at);
    this.cursor.hidden = !(x >= chartArea.left - 1 && x <= chartArea.right + 1);
    Object.assign(
        this.cursor.style,
        {left: x + 'px', top: chartArea.top + 'px', height: chartArea.bottom - chartArea.top + 'px'});
  }

  zoom(range) {
    Object.assign(this.chart.options.scales.x, {min: range?.[0], max: range?.[1]});
    this.chart.update();
    this.draw_cursor();
  }

  take_pointer() {
    const {canvas, options} = this;
    let begin = null;
    const zone = element('div', {class: 'zone', hidden: true});
    this.frame.append(zone);
    const place = (event) => event.clientX - canvas.getBoundingClientRect().left;
    new ResizeObserver(() => this.draw_cursor()).observe(canvas);
    if (!options.zoomed) return;
    canvas.addEventListener('pointerdown', (event) => {
      begin = place(event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (begin === null) return;
      const {chartArea} = this.chart, x = place(event);
      zone.hidden = Math.abs(x - begin) < 6;
      Object.assign(zone.style, {
        left: Math.min(x, begin) + 'px',
        width: Math.abs(x - begin) + 'px',
        top: chartArea.top + 'px',
        height: chartArea.bottom - chartArea.top + 'px'
      });
    });
    canvas.addEventListener('pointerup', (event) => {
      if (begin === null) return;
      const {scales} = this.chart, ends = [begin, place(event)].sort((a, b) => a - b);
      begin = null;
      zone.hidden = true;
      if (ends[1] - ends[0] >= 6)
        options.zoomed(ends.map((x) => scales.x.getValueForPixel(x)));
      else if (options.picked)
        options.picked(scales.x.getValueForPixel(ends[0]));
    });
    canvas.addEventListener('dblclick', () => options.zoomed(null));
  }

  remove() {
    this.chart?.destroy();
    this.chart = null;
  }
}

function unit_text(unit) { return unit && unit !== '1' ? ' ' + unit : ''; }

/** Chart.js gives the last tick twice. */
function linear_tick(value, index, ticks) {
  return index > 0 && ticks[index - 1].value === value ? null : digits(value, 4);
}

function log_tick(value) {
  const lead = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
  return [1, 2, 5].some((n) => Math.abs(lead - n) < 1e-6) ? digits(value, 3) : null;
}

/** Value of the last sample at or before x, else of the first; not interpolated. */
function value_near(points, x) {
  let low = 0, high = points.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (points[middle].x <= x * (1 + 1e-12))
      low = middle + 1;
    else
      high = middle;
  }
  return low ? points[low - 1].y : points.length ? points[0].y : null;
}
