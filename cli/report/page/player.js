// Frames of runs, in step with the clock.

const preload_ahead = 12;  // frames

function player(run, clock) {
  const name = name_of_run(run);
  const image = element('img', {width: 1280, height: 720, decoding: 'async'});
  const caption = element('output', {});
  const fetched = new Map();  // Image objects keep their pictures in memory
  const fetch_frame = (k) => {
    if (k < 0 || k >= run.frames.length || fetched.has(k)) return;
    const ahead = new Image();
    ahead.src = run.frames[k].src;
    fetched.set(k, ahead);
  };
  let shown = -1;
  clock.listen(() => {
    const times = run.frames.map((frame, k) => frame.t ?? k);
    let k = 0;
    while (k + 1 < times.length && times[k + 1] <= clock.time * (1 + 1e-9)) ++k;
    if (k === shown) return;
    shown = k;
    image.src = run.frames[k].src;
    const when = run.frames[k].t === null ? '' : ', t = ' + brief(times[k]) + ' s';
    image.alt =
        `Frame ${k + 1} of ${run.frames.length} of ${run.record.scene} with ${run.record.method}${when}`;
    caption.textContent = `frame ${k + 1} of ${run.frames.length}${when}`;
    if (clock.playing || k > 0)
      for (let ahead = 1; ahead <= preload_ahead; ++ahead) fetch_frame(k + ahead);
  });
  image.addEventListener('load', () => {  // reserves the space of the next frame
    image.width = image.naturalWidth;
    image.height = image.naturalHeight;
  });
  return element(
      'figure', {class: 'player'},
      element(
          'figcaption', {},
          element(
              'span', {}, run_key(run), element('strong', {}, run.record.method), ' ',
              badge(run.record.verdict), run.record.status === 'finished' ? null : ' ' + run.record.status),
          element('a', {href: run.link, class: 'soft'}, name), caption),
      image);
}

/** Sample of the run's line in the plots, on a page of several runs. */
function run_key(run) {
  if (!run.many) return null;
  const key = element('span', {class: 'key', 'aria-hidden': 'true'});
  const paint = () => {
    key.style.borderTopColor = on_theme(run.style.color);
  };
  theme_listeners.push(paint);
  paint();
  if (run.style.dash > 1) key.style.borderTopStyle = run.style.dash === 3 ? 'dotted' : 'dashed';
  return key;
}

function timeline(runs, clock) {
  const range = element('input', {
    type: 'range',
    min: 0,
    max: clock.last,
    step: 1,
    'aria-label': 'Frame',
    oninput: () => {
      clock.stop_at(Number(range.value));
    }
  });
  const line = element('div', {class: 'timeline'}, range);
  const begin = clock.times[0], end = clock.times[clock.last];
  for (const run of runs)
    for (const [verdict, t] of since_of(run.record)) {
      if (!(end > begin) || t > end) continue;
      const share = (t - begin) / (end - begin);
      const text = `${verdict} since ${brief(t)} s` + (run.many ? ` (${name_of_run(run)})` : '');
      const mark = element(
          'button', {
            type: 'button',
            class: 'mark',
            'data-verdict': verdict,
            title: text,
            'aria-label': text,
            onclick: () => {
              clock.go_to(t);
            }
          },
          verdict_signs[verdict] || verdict);
      mark.style.left = `calc(8px + (100% - 16px) * ${share})`;  // half a thumb at each end
      line.append(mark);
    }
  clock.listen(() => {
    range.value = clock.index;
    range.setAttribute(
        'aria-valuetext', `frame ${clock.index + 1} of ${clock.last + 1}, ${brief(clock.time)} s`);
  });
  return line;
}

function controls(runs, clock) {
  const button = (text, label, onclick) =>
      element('button', {type: 'button', 'aria-label': label, title: label, onclick}, text);
  const play = button('▶ Play', 'Play', () => clock.play());
  play.className = 'primary';
  const time = element('output', {class: 'clock'});
  clock.listen(() => {
    play.textContent = clock.playing ? '❚❚ Pause' : '▶ Play';
    play.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
    time.textContent = `t = ${brief(clock.time)} s · ${clock.index + 1} / ${clock.last + 1}`;
  });
  const rate = choice('Speed', [2, 5, 10, 20, 40].map((n) => [String(n), n + ' frames/s']), '20', (value) => {
    clock.rate = Number(value);
  });
  const step = (by) => () => {
    clock.stop_at(clock.index + by);
  };
  return element(
      'div', {class: 'controls'}, timeline(runs, clock),
      element(
          'div', {class: 'bar'}, play, button('|◀', 'First frame', step(-Infinity)),
          button('◀', 'Previous frame', step(-1)), button('▶', 'Next frame', step(1)),
          button('▶|', 'Last frame', step(Infinity)), rate, time,
          element(
              'span', {class: 'soft'}, element('kbd', {}, 'Space'), ' play ', element('kbd', {}, '←'), ' ',
              element('kbd', {}, '→'), ' step ', element('kbd', {}, 'Home'), ' ', element('kbd', {}, 'End'),
              ' ends')));
}

/** Keys of the page, unless the focused control uses the key. */
function take_keys(clock) {
  document.onkeydown = (event) => {
    const tag = event.target.tagName;
    if (event.ctrlKey || event.altKey || event.metaKey || ['SELECT', 'TEXTAREA'].includes(tag)) return;
    if (tag === 'INPUT' && event.target.type !== 'checkbox' && event.key !== ' ') return;
    if ([' ', 'Enter'].includes(event.key) && ['BUTTON', 'SUMMARY', 'A'].includes(tag)) return;
    if (event.key === ' ' && tag === 'INPUT' && event.target.type !== 'range') return;
    const step =
        {ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity}[event.key];
    if (event.key === ' ')
      clock.play();
    else if (step !== undefined && event.target.type !== 'range') {
      clock.stop_at(clock.index + step);
    } else
      return;
    event.preventDefault();
  };
}

function players(runs) {
  const clock = clock_of(runs);
  const drawn = runs.filter((run) => run.frames.length);
  take_keys(clock);
  if (!drawn.length) return {clock, box: null};
  const box = section(
      runs.length > 1 ? 'Frames side by side' : 'Frames',
      element('div', {class: 'players'}, drawn.map((run) => player(run, clock))), controls(runs, clock));
  return {clock, box};
}
