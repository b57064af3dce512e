// Builds the page from taut_report and taut_runs.

/** Loads the data of a run unless they are loaded. */
function load_run(index) {
  const script = taut_report.scripts[index];
  if (taut_runs[index] || !script) return Promise.resolve(taut_runs[index]);
  return load_script(script).then(() => taut_runs[index]);
}

function load_script(address) {
  return new Promise((resolve, reject) => {
    const script = element('script', {src: address});
    script.onload = () => {
      script.remove();
      resolve();
    };
    script.onerror = () => {
      script.remove();
      reject(new Error('cannot load ' + address));
    };
    document.head.append(script);
  });
}

function show_head(title, about, ...more) {
  document.title = title + ' · taut';
  const titles = element(
      'div', {class: 'titles'}, element('h1', {}, title),
      about ? element('p', {class: 'about'}, about) : null);
  document.getElementById('head').replaceChildren(titles, ...more.filter(Boolean), theme_switch());
  document.getElementById('foot').textContent = 'Written by taut report, version ' + taut_report.taut + '.';
}

function show_parts(place, parts) {
  const shown = parts.filter(Boolean);
  for (const canvas of place.querySelectorAll('canvas')) canvas.plot?.remove();
  place.replaceChildren(...shown);
  const sections = [...place.querySelectorAll('section')];
  for (const part of sections) part.ready?.();
  const draw_plots = () => {
    for (const part of sections.filter((one) => one.isConnected)) part.later?.();
  };
  requestAnimationFrame(() => setTimeout(draw_plots));  // after the browser has painted the rest
}

function run_parts(run, index) {
  run.many = false;
  run.style ??= {color: '#0072B2', dash: 1};
  const {clock, box} = players([run]);
  return {
    clock,
    parts: [
      box ? element(
                'div', {class: 'two'}, box,
                element('div', {class: 'stack'}, verdict_section(run), measures_section(run))) :
            element('div', {class: 'two'}, measures_section(run), verdict_section(run)),
      orbit_section(run, index, clock), histories([run], clock), run_details(run)
    ]
  };
}

function show_run(run) {
  show_head(
      run.title || run.record.scene,
      `${run.record.scene} with ${run.record.method}, ${run.record.particles} particles, ` +
          `dp = ${brief(run.record.spacing)} m`,
      badge(run.record.verdict));
  return run_parts(run, 0);
}

function show_runs(runs) {
  runs.forEach((run, k) => {
    run.many = true;
    run.style.dash =
        Math.max(run.style.dash, [1, 2, 4, 5][k % 4]);  // lines also differ without colours
  });
  const scenes = [...new Set(runs.map((run) => run.title || run.record.scene))];
  show_head(scenes.join(' / '), runs.map(name_of_run).join(', '));
  const {clock, box} = players(runs);
  const orbits = runs.map((run, k) => orbit_section(run, k, clock));
  return {
    clock,
    parts: [box, measures_of_runs(runs), ...orbits, histories(runs, clock), ...runs.map(run_details)]
  };
}

/** Looks for newer data while a run continues. `shown`: the data on the page. */
function refresh(clock, shown) {
  if (!taut_report.running) return;
  setTimeout(async () => {
    const query = '?' + Date.now();
    try {
      await load_script('data.js' + query);  // first, because data.js is written last
      for (const script of taut_report.scripts.filter(Boolean)) await load_script(script + query);
    } catch { /* the page stays as it is */
    }
    if (loaded_data() === shown) return refresh(clock, shown);
    globalThis.taut_particles = {};
    clock.playing = false;
    build(clock);
  }, 2000);
}

function loaded_data() { return JSON.stringify([taut_report, taut_runs]); }

/** `before`: the clock of the page that this one replaces. */
async function build(before = null) {
  theme_listeners.length = 0;
  const content = document.getElementById('content'), place = scrollY;
  try {
    if (taut_report.kind === 'sweep') return show_parts(content, show_sweep(taut_report));
    if (taut_report.kind === 'difference') return show_parts(content, show_difference(taut_report));
    if (taut_report.kind === 'suite') return show_parts(content, show_suite(taut_report));
    const runs = await Promise.all(taut_report.scripts.map((_, k) => load_run(k)));
    const shown = loaded_data();
    const {clock, parts} = runs.length === 1 ? show_run(runs[0]) : show_runs(runs);
    show_parts(content, parts);
    if (before) clock.go(before.index === before.last ? clock.last : before.index);
    if (before) requestAnimationFrame(() => setTimeout(() => scrollTo(0, place)));  // once there are plots
    refresh(clock, shown);
  } catch (error) {
    content.replaceChildren(
        element('section', {role: 'alert'}, element('p', {}, 'This page cannot be shown: ' + error.message)));
    throw error;
  }
}

addEventListener('DOMContentLoaded', () => {
  apply_theme();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', apply_theme);
  build();
});
