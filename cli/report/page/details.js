// Parameters, the command, provenance and the scene file of a run.

function command_block(label, words, folder) {
  const text = words.map(shell_word).join(' ');
  const state = element('span', {role: 'status', class: 'soft'});
  const copy = element(
      'button', {
        type: 'button',
        'aria-label': 'Copy: ' + label,
        onclick: async () => {
          try {
            await navigator.clipboard.writeText(text);
            state.textContent = ' copied';
          } catch {
            getSelection().selectAllChildren(block);
            state.textContent = ' selected: press Ctrl+C';
          }
        }
      },
      'Copy');
  const block = element('code', {}, text);
  return element(
      'div', {}, element('div', {class: 'bar'}, element('h3', {}, label), copy, state),
      folder ? element('div', {class: 'soft'}, 'in ' + folder) : null,
      element('pre', {class: 'command'}, block));
}

function table_of(caption, values) {
  const text = (value) => Array.isArray(value) ? value.join(' ') : value === null ? '–' : value;
  return element(
      'div', {class: 'scroll keys'},
      element(
          'table', {}, element('caption', {}, caption),
          element(
              'tbody', {},
              Object.entries(values).map(
                  ([name, value]) =>
                      element('tr', {}, element('th', {scope: 'row'}, name), cell(text(value)))))));
}

function run_details(run) {
  const {record} = run, provenance = record.provenance || {}, command = provenance.command || [];
  const settings = {};
  for (const key
           of ['scene', 'method', 'material_law', 'contact', 'stepping', 'cfl', 'dim', 'spacing',
               'spacing_asked', 'jitter', 'particles', 'mass', 'steps', 'threads', 'machine',
               'particle_steps_per_second'])
    if (record[key] !== undefined) settings[key] = record[key];
  const plain =
      Object.fromEntries(Object.entries(provenance).filter(([, value]) => typeof value !== 'object'));
  return section(
      run.many ? 'Details of ' + name_of_run(run) : 'Parameters, command, provenance',
      run.source ? element('p', {class: 'soft'}, 'Source of the scene: ' + run.source) : null,
      command_block('Repeat this run', ['taut', 'run', run.folder.replace(/\/+$/, '') + '/scene.toml']),
      command.length ?
          command_block('Command of this run', ['taut', ...command.slice(1)], provenance.working_folder) :
          null,
      element(
          'details', {open: !run.many}, element('summary', {}, 'Parameters and settings'),
          element(
              'div', {class: 'players'}, table_of('Parameters of the scene', record.parameters || {}),
              table_of('Settings and size', settings))),
      element(
          'details', {}, element('summary', {}, 'Provenance'),
          element(
              'div', {class: 'players'}, table_of('Build and process', {taut: record.taut, ...plain}),
              table_of('Libraries', provenance.libraries || {}), table_of('Seconds', record.seconds || {}))),
      run.scene ?
          element(
              'details', {}, element('summary', {}, 'Scene file'), element('pre', {tabindex: 0}, run.scene)) :
          null,
      element('p', {}, 'Files: ', element('a', {href: run.link}, run.folder)));
}
