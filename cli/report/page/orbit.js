// Saved particles of a run in 3D, drawn by WebGL as spheres that the reader can turn.

const orbit_vertex = `
  attribute vec3 place; attribute vec3 color;
  uniform mat3 turn; uniform vec3 middle, size, cut; uniform vec2 scale; uniform float diameter, cut_at;
  varying vec3 shown; varying float hidden;
  void main() {
    vec3 seen = turn * (place * size - middle);
    gl_Position = vec4(seen.xy * scale, -seen.z / (2.0 * length(size)), 1.0);
    gl_PointSize = diameter;
    shown = color;
    hidden = dot(place, cut) > cut_at ? 1.0 : 0.0;
  }`;
const orbit_fragment = `
  precision mediump float;
  varying vec3 shown; varying float hidden;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float r2 = dot(at, at);
    if (hidden > 0.5 || r2 > 1.0) discard;
    vec3 normal = vec3(at.x, -at.y, sqrt(1.0 - r2));
    float light = 0.62 + 0.38 * max(dot(normal, normalize(vec3(-0.4, 0.6, 0.8))), 0.0);
    gl_FragColor = vec4(shown * light, 1.0);
  }`;

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a) {
  const length = Math.hypot(...a) || 1;
  return a.map((x) => x / length);
}

function combined(...terms) {
  return [0, 1, 2].map((k) => terms.reduce((sum, [factor, vector]) => sum + factor * vector[k], 0));
}

/** Direction of view in rad: angle `turned` about the scene's up direction, and angle `raised` above the horizontal. */
class Orbit {
  constructor(data) {
    this.data = data;
    this.up = unit(data.up);
    const across = cross(this.up, unit(data.towards));
    this.right0 =
        unit(Math.hypot(...across) > 1e-6 ? across : cross(this.up, [this.up[2], this.up[0], this.up[1]]));
    this.front0 = cross(this.right0, this.up);
    this.reset();
  }

  reset() {
    this.turned = 0;
    const sine = unit(this.data.towards).reduce((sum, x, k) => sum + x * this.up[k], 0);
    this.raised = Math.asin(Math.min(Math.max(sine, -1), 1));
    this.zoom = 1.5;
  }

  /** Rows: right, up, towards the reader. */
  axes() {
    const c = Math.cos(this.turned), s = Math.sin(this.turned);
    const right = combined([c, this.right0], [s, this.front0]);
    const front = cross(right, this.up);
    const back = combined([Math.cos(this.raised), front], [Math.sin(this.raised), this.up]);
    return [right, cross(back, right), back];
  }
}

function compiled(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, orbit_vertex], [gl.FRAGMENT_SHADER, orbit_fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  return program;
}

class OrbitView {
  constructor(data, clock, name) {
    this.data = data;
    this.orbit = new Orbit(data);
    this.decoded = new Map();
    this.cut = {axis: 0, at: 1};
    this.size = data.high.map((high, k) => high - data.low[k]);
    this.canvas = element('canvas', {
      tabindex: 0,
      role: 'img',
      'aria-label': `Particles of ${name}, to turn with the pointer or the arrow keys, to zoom with + and -`
    });
    this.readout = element('output', {});
    this.gl = this.canvas.getContext('webgl', {antialias: true, preserveDrawingBuffer: true});
    if (!this.gl) return;
    this.program = compiled(this.gl);
    this.buffer = this.gl.createBuffer();
    this.take_pointer();
    this.take_keys();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    clock.listen(() => this.show(clock.time));
  }

  bytes(index) {
    if (!this.decoded.has(index))
      this.decoded.set(index, Uint8Array.from(atob(this.data.data[index]), (letter) => letter.charCodeAt(0)));
    return this.decoded.get(index);
  }

  /** Shows the last saved time at or before `time`. */
  show(time) {
    let index = 0;
    while (index + 1 < this.data.times.length && this.data.times[index + 1] <= time * (1 + 1e-9)) ++index;
    if (index === this.index) return;
    this.index = index;
    const {gl} = this, count = this.data.particles;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, this.bytes(index), gl.DYNAMIC_DRAW);
    const attribute = (name, type, stride, offset) => {
      const place = gl.getAttribLocation(this.program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, type, true, stride, offset);
    };
    attribute('place', gl.UNSIGNED_SHORT, 6, 0);
    attribute('color', gl.UNSIGNED_BYTE, 3, 6 * count);
    this.readout.textContent = `t = ${brief(this.data.times[index])} s, ${count} particles`;
    this.draw();
  }

  draw() {
    const {gl, canvas, orbit, size} = this, ratio = devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (!width || !height || this.index === undefined) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    gl.viewport(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [right, up, back] = orbit.axes();
    const pixels =
        orbit.zoom * Math.min(width, height) / (Math.hypot(...size) + this.data.diameter);  // per m
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    gl.uniformMatrix3fv(uniform('turn'), false, [0, 1, 2].flatMap((k) => [right[k], up[k], back[k]]));
    gl.uniform3fv(uniform('size'), size);
    gl.uniform3fv(uniform('middle'), size.map((x) => x / 2));
    gl.uniform2f(uniform('scale'), 2 * pixels / width, 2 * pixels / height);
    gl.uniform1f(uniform('diameter'), Math.max(this.data.diameter * pixels, 1.5));
    gl.uniform3fv(uniform('cut'), [0, 1, 2].map((k) => k === this.cut.axis ? 1 : 0));
    gl.uniform1f(uniform('cut_at'), this.cut.at);
    gl.drawArrays(gl.POINTS, 0, this.data.particles);
  }

  turn(right, up) {
    this.orbit.turned += right;
    this.orbit.raised = Math.min(Math.max(this.orbit.raised + up, -Math.PI / 2), Math.PI / 2);
    this.draw();
  }

  magnify(factor) {
    this.orbit.zoom = Math.min(Math.max(this.orbit.zoom * factor, 0.2), 50);
    this.draw();
  }

  take_pointer() {
    let last = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      last = event;
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!last) return;
      this.turn((event.clientX - last.clientX) / 150, (event.clientY - last.clientY) / 150);
      last = event;
    });
    this.canvas.addEventListener('pointerup', () => {
      last = null;
    });
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.magnify(Math.exp(-event.deltaY / 600));
    }, {passive: false});
  }

  take_keys() {
    const actions = {
      ArrowLeft: () => this.turn(-0.1, 0),
      ArrowRight: () => this.turn(0.1, 0),
      ArrowUp: () => this.turn(0, 0.1),
      ArrowDown: () => this.turn(0, -0.1),
      '+': () => this.magnify(1.2),
      '-': () => this.magnify(1 / 1.2)
    };
    this.canvas.addEventListener('keydown', (event) => {
      if (!actions[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
      actions[event.key]();
      event.preventDefault();
      event.stopPropagation();
    });
  }

  reset() {
    this.orbit.reset();
    this.draw();
  }
}

function color_key({label, unit, low, high, names, colors}) {
  const title = label + (unit ? ', ' + unit : '');
  if (names)
    return element(
        'ul', {class: 'legend'},
        names.map(
            (name, k) => element(
                'li', {}, element('span', {class: 'swatch', style: `background: ${colors[k]}`}), name)));
  const ramp = element(
      'span',
      {class: 'ramp', role: 'img', 'aria-label': `colours of ${title} from ${brief(low)} to ${brief(high)}`});
  ramp.style.background = `linear-gradient(to right, ${colors.join(', ')})`;
  return element('p', {}, `${title}: ${brief(low)} `, ramp, ` ${brief(high)}`);
}

/** Section with the saved particles of a run, or null. `later` loads them. */
function orbit_section(run, index, clock) {
  if (!taut_report.particle_scripts?.[index] && !taut_particles[index]) return null;
  const box = element('div', {}, element('p', {class: 'soft'}, 'Loading the particles …'));
  const part = section(run.many ? 'Particles of ' + name_of_run(run) : 'Particles in 3D', box);
  part.later = async () => {
    if (!taut_particles[index])
      await load_script(taut_report.particle_scripts[index] + (taut_report.running ? '?' + Date.now() : ''));
    const data = taut_particles[index];
    const view = new OrbitView(data, clock, run.record.scene);
    if (!view.gl)
      return box.replaceChildren(
          element('p', {class: 'soft'}, 'This browser has no WebGL, which draws the particles.'));
    const at = element('input', {
      type: 'range',
      min: 0,
      max: 1000,
      value: 1000,
      'aria-label': 'Place of the cut',
      oninput: () => {
        view.cut.at = at.value / 1000;
        view.draw();
      }
    });
    const button = (text, act) => element('button', {type: 'button', onclick: act}, text);
    box.replaceChildren(
        element('div', {class: 'orbit'}, view.canvas),
        element(
            'div', {class: 'bar'}, button('Turn left', () => view.turn(-0.2, 0)),
            button('Turn right', () => view.turn(0.2, 0)), button('Raise', () => view.turn(0, 0.2)),
            button('Lower', () => view.turn(0, -0.2)), button('+', () => view.magnify(1.25)),
            button('−', () => view.magnify(0.8)), button('Reset view', () => view.reset()),
            choice(
                'Hide beyond', [['0', 'x'], ['1', 'y'], ['2', 'z']], '0',
                (axis) => {
                  view.cut.axis = Number(axis);
                  view.draw();
                }),
            element('label', {class: 'cut'}, at), view.readout),
        ...[color_key(data.key), run.frames.length ? null : controls([run], clock),
            data.every > 1 ? element('p', {class: 'soft'}, `One saved time in ${data.every} is shown.`) :
                             null]
            .filter(Boolean));
    view.draw();
  };
  return part;
}
