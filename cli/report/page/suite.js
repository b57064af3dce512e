// A suite of snapshots: an index of its entries, and the pictures of the chosen entry.

function result_of_entry(entry) {
  if (entry.problem) return badge('diverged', '✕ no result');
  const {alike, pictures} = entry.comparison;
  if (entry.differs_from)
    return alike ? badge('fractured', '= alike, must differ') : badge('stable', '≠ differs, as it must');
  if (!alike) return badge('fractured', '≠ different');
  const warns = pictures.some((picture) => picture.warns);
  return warns ? badge('hourglass', '! alike, with a warning') : badge('stable', '= alike');
}

function passes(entry) {
  return !entry.problem && (entry.differs_from ? !entry.comparison.alike : entry.comparison.alike);
}

function entry_rows(entry) {
  if (entry.problem) return [element('td', {colspan: 4}, entry.problem)];
  const {comparison} = entry, worst = comparison.pictures.find((picture) => picture.greatest > 0);
  return [
    cell(comparison.pictures.length),
    cell(comparison.different + comparison.only_in_expected.length + comparison.only_in_got.length),
    cell(worst ? worst.name : null), cell(worst ? worst.greatest : null)
  ];
}

function thumbnail(entry) {
  const worst = entry.problem ? null : entry.comparison.pictures[0];
  return worst ? element('img', {src: worst.got, alt: '', loading: 'lazy', width: 96, height: 54}) : null;
}

function show_entry(entry, place) {
  place.stop?.();
  place.stop = null;
  if (entry.problem)
    return place.replaceChildren(section(entry.name, element('p', {class: 'warning'}, entry.problem)));
  const pictures = new PictureComparison(entry.comparison), part = pictures.part();
  place.stop = () => {
    clearInterval(pictures.timer);
    document.onkeydown = null;
  };
  const about = element(
      'p', {class: 'soft'}, `expected: ${entry.comparison.expected}, got: ${entry.comparison.got}`,
      entry.differs_from ? `. A control: it must differ from the baseline of ${entry.differs_from}.` : '');
  place.replaceChildren(...[verdict_of_pictures(entry.comparison, entry.name, about), part].filter(Boolean));
  part?.ready();
}

function show_suite(report) {
  const {entries} = report, place = element('div', {class: 'stack'});
  const failed = entries.filter((entry) => !passes(entry));
  show_head(
      report.title, report.file,
      failed.length ? badge('fractured', `${failed.length} of ${entries.length} entries failed`) :
                      badge('stable', `all of ${entries.length} entries passed`));
  const buttons = entries.map(
      (entry) => element(
          'button', {type: 'button', onclick: () => choose(entry)}, thumbnail(entry),
          element('span', {}, entry.name)));
  const choose = (entry) => {
    buttons.forEach((button, k) => button.setAttribute('aria-pressed', entries[k] === entry));
    show_entry(entry, place);
  };
  const heads = ['entry', 'result', 'frames', 'different', 'worst', 'ΔE*ab'];
  const numbers = ['frames', 'different', 'ΔE*ab'];
  const index = section(
      'Entries',
      element(
          'div', {class: 'scroll wide entries'},
          element(
              'table', {},
              element(
                  'thead', {},
                  element(
                      'tr', {},
                      heads.map(
                          (head) => element(
                              'th', {scope: 'col', class: numbers.includes(head) ? 'number' : null}, head)))),
              element(
                  'tbody', {},
                  entries.map(
                      (entry, k) => element(
                          'tr', {}, element('th', {scope: 'row'}, buttons[k]),
                          element('td', {}, result_of_entry(entry)), entry_rows(entry)))))));
  index.ready = () => choose(failed[0] || entries[0]);
  return [index, place];
}
