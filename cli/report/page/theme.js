// Dark or light theme: the system's, unless the reader switches.

const theme_listeners = [];

function stored_theme() {
  try {
    return localStorage.getItem('taut-theme');
  } catch {
    return null;
  }  // a browser may forbid storage for pages from files
}

function is_dark() { return document.documentElement.dataset.theme === 'dark'; }

function apply_theme() {
  const system = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  document.documentElement.dataset.theme = stored_theme() || system;
  for (const listener of theme_listeners) listener();
}

function theme_switch() {
  const button = element('button', {
    type: 'button',
    onclick: () => {
      try {
        localStorage.setItem('taut-theme', is_dark() ? 'light' : 'dark');
      } catch { /* this page only */
      }
      document.documentElement.dataset.theme = is_dark() ? 'light' : 'dark';
      for (const listener of theme_listeners) listener();
    }
  });
  const label = () => {
    button.textContent = is_dark() ? '☀ Light' : '☾ Dark';
  };
  theme_listeners.push(label);
  label();
  return button;
}

function css_color(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

/** Lighter on a dark page. */
function on_theme(color) {
  if (!is_dark()) return color;
  const parts = [1, 3, 5].map((k) => parseInt(color.slice(k, k + 2), 16));
  return 'rgb(' + parts.map((c) => Math.round(c + (255 - c) * 0.42)).join(',') + ')';
}

// dash types 1 to 5 of gnuplot
const dash_patterns = [[], [], [8, 4], [2, 3], [10, 3, 2, 3], [10, 3, 2, 3, 2, 3]];
function dash_of(style) { return dash_patterns[style.dash] || []; }
