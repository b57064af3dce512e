// Pictures compared with the expected ones, most different first.

function percent(share) { return brief(100 * share) + ' %'; }

function verdict_of_pictures(report, title = 'Verdict', about = null) {
  const {limits} = report, missing = report.only_in_expected.length + report.only_in_got.length;
  const rule = limits.greatest === null ?
      `Pictures are alike if at most ${percent(limits.share)} of the pixels differ visibly (ΔE*ab above ${
          limits.tolerance}), and at most ` +
          `${percent(limits.densest)} of the pixels of any window of 16 × 16.` :
      `Pictures are alike if no pixel differs by more than ΔE*ab = ${brief(limits.greatest)}.`;
  return section(
      title, about,
      element(
          'p', {}, alike_badge(report.alike),
          ` ${report.different} of ${report.pictures.length} pictures differ` +
              (missing ? `, ${missing} exist on one side only` : '')),
      element(
          'p', {class: 'soft'},
          rule + (limits.warn === null ? '' : ` A pixel above ΔE*ab = ${brief(limits.warn)} warns.`)),
      element(
          'p', {}, 'Differences: ',
          element('span', {class: 'ramp', role: 'img', 'aria-label': 'colours from orange to dark red'}),
          ` ΔE*ab from ${
              limits
                  .tolerance} (just visible, orange) to 50 and more (dark red); black and white differ by 100. ` +
              'The blue frame marks the 16 × 16 window with the most differing pixels. ' +
              'Grey: the expected picture, paler.'),
      [['Only expected', report.only_in_expected], ['Only got', report.only_in_got]]
          .filter(([, names]) => names.length)
          .map(
              ([label, names]) => element(
                  'p', {class: 'warning'}, label + ': ',
                  names.map(({name, src}) => [element('a', {href: src}, name), ' ']))));
}

function picture_values(picture, limits) {
  const row = (label, ...values) => element(
      'tr', {}, element('th', {scope: 'row'}, label),
      values.map((value) => element('td', {class: 'number'}, brief(value))));
  return element(
      'div', {class: 'scroll'},
      element(
          'table', {},
          element(
              'thead', {},
              element(
                  'tr', {},
                  ['quantity', 'value', 'limit'].map(
                      (head, k) => element('th', {scope: 'col', class: k ? 'number' : null}, head)))),
          element(
              'tbody', {},
              row('pixels that differ visibly', percent(picture.share),
                  limits.greatest === null ? percent(limits.share) : '–'),
              row('densest window', percent(picture.densest),
                  limits.greatest === null ? percent(limits.densest) : '–'),
              row('greatest difference, ΔE*ab', picture.greatest, limits.greatest ?? '–'))));
}

class PictureComparison {
  constructor(report) {
    this.report = report;
    this.index = 0;
    this.way = 'side by side';
    this.share = 50;  // part of the width that shows the expected picture, %
    this.box = element('div');
    this.buttons = report.pictures.map(
        (picture, k) => element(
            'button', {type: 'button', onclick: () => this.go(k)},
            element('img', {src: picture.got, alt: '', loading: 'lazy', width: 160, height: 90}),
            picture.name, element('br'),
            picture.warns ? badge('hourglass', '! warning') : alike_badge(picture.alike), element('br'),
            `ΔE ${brief(picture.greatest)}, ${percent(picture.share)}`));
  }

  get picture() { return this.report.pictures[this.index]; }

  image(kind) {
    const src = this.picture[kind];
    return src ?
        element(
            'img', {src, alt: `${kind === 'difference' ? 'differences in' : kind} ${this.picture.name}`}) :
        element('p', {class: 'soft'}, 'No pixel differs.');
  }

  figure(kind) { return element('figure', {}, element('figcaption', {}, kind), this.image(kind)); }

  over(controls, place) {
    const top = element('div', {class: 'top'}, this.image('expected'));
    const edge = element('div', {class: 'edge'}),
          box = element('div', {class: 'over'}, this.image('got'), top, edge);
    place(top, edge);
    return [controls, box];
  }

  slider() {
    const range = element('input', {
      type: 'range',
      class: 'share',
      min: 0,
      max: 100,
      value: this.share,
      'aria-label': 'Share of the expected picture, %'
    });
    const caption = element('p', {class: 'soft'}, 'left: expected, right: got');
    return this.over([caption, range], (top, edge) => {
      const place = () => {
        this.share = Number(range.value);
        top.style.clipPath = `inset(0 ${100 - this.share}% 0 0)`;
        edge.style.left = this.share + '%';
      };
      range.addEventListener('input', place);
      place();
    });
  }

  blink() {
    const caption = element('output', {});
    return this.over(caption, (top, edge) => {
      edge.remove();
      const show = (expected) => {
        top.hidden = !expected;
        caption.textContent = expected ? 'expected' : 'got';
      };
      show(true);
      this.timer = setInterval(() => show(top.hidden), 700);
    });
  }

  draw() {
    clearInterval(this.timer);
    this.buttons.forEach((button, k) => button.setAttribute('aria-pressed', k === this.index));
    const content = this.way === 'slider' ?
        this.slider() :
        this.way === 'blink' ?
        this.blink() :
        element(
            'div', {class: 'compare'}, ['expected', 'got', 'difference'].map((kind) => this.figure(kind)));
    const way = (name) => element(
        'button', {
          type: 'button',
          'aria-pressed': this.way === name,
          'data-way': name,
          onclick: () => {
            this.way = name;
            this.draw();
            this.box.querySelector(`[data-way="${name}"]`).focus();
          }
        },
        name);
    this.box.replaceChildren(
        element(
            'div', {class: 'bar'}, element('h3', {}, this.picture.name),
            ['side by side', 'slider', 'blink'].map(way),
            element(
                'span', {class: 'soft'}, element('kbd', {}, '←'), ' ', element('kbd', {}, '→'),
                ' other picture')),
        element('p'), ...[content].flat(2), element('p'), picture_values(this.picture, this.report.limits));
  }

  go(index) {
    this.index = Math.min(Math.max(index, 0), this.report.pictures.length - 1);
    this.draw();
    this.buttons[this.index].scrollIntoView({block: 'nearest', inline: 'nearest'});
  }

  part() {
    if (!this.report.pictures.length) return null;
    const part = section(
        'Pictures, most different first',
        element('ul', {class: 'thumbs'}, this.buttons.map((button) => element('li', {}, button))), this.box);
    part.ready = () => this.draw();
    document.onkeydown = (event) => {
      const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
      if (!step || event.target.tagName === 'INPUT' || event.ctrlKey || event.altKey || event.metaKey) return;
      this.go(this.index + step);
      event.preventDefault();
    };
    return part;
  }
}

function show_difference(report) {
  show_head('Pictures of ' + report.got, 'expected: ' + report.expected, alike_badge(report.alike));
  return [verdict_of_pictures(report), new PictureComparison(report).part()];
}
