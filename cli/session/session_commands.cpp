#include "cli/session/session_commands.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>

#include <fmt/core.h>

#include "cli/run/history.hpp"
#include "cli/run/schedule.hpp"
#include "cli/session/terminal.hpp"
#include "cli/study/history_plot.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Words = std::vector<std::string>;

const std::map<std::string, std::string, std::less<>> synonyms{{"?", "help"}, {"exit", "quit"}};

const SessionCommand& find_command(const std::string& given) {
  const auto synonym = synonyms.find(given);
  const std::string& name = synonym == synonyms.end() ? given : synonym->second;
  const auto all = session_commands();
  const auto found = std::ranges::find(all, name, &SessionCommand::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const SessionCommand& command : all) names.emplace_back(command.name);
  throw UsageError(unknown_name("command", name, names));
}

std::string usage(const SessionCommand& command) {
  return fmt::format("{}{}{}", command.name, command.arguments.empty() ? "" : " ", command.arguments);
}

[[noreturn]] void wrong_words(std::string_view name) {
  throw UsageError("usage: " + usage(find_command(std::string(name))));
}

double number(const std::string& word) {
  const auto value = parsed<double>(word);
  if (!value || !std::isfinite(*value)) throw UsageError(fmt::format("'{}' is not a number", word));
  return *value;
}

void say_time(const Session& session, const Dialogue& to) {
  if (to.interrupts.interrupted()) to.out << "# interrupted\n";
  to.out << "t=" << exact(session.simulation().time()) << " step=" << session.simulation().steps() << '\n';
}

void step(Session& session, const Words& words, const Dialogue& to) {
  constexpr double most = 1e9;
  if (words.size() > 1) wrong_words("step");
  const double count = words.empty() ? 1 : number(words[0]);
  if (count < 1 || count > most || count != std::floor(count))
    throw UsageError(
        fmt::format("the number of steps is '{}'; it must be a whole number from 1 to a billion", words[0]));
  session.step(static_cast<long>(count), to.interrupts);
  say_time(session, to);
}

void run(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 2 || words[0] != "until") wrong_words("run");
  const double until = number(words[1]);
  if (session.simulation().time() > until)
    to.out << "# the session is past " << brief(until) << " s; `reset` returns to the start\n";
  session.run_until(until, to.interrupts, to.progress);
  say_time(session, to);
}

/// "LOW:HIGH|auto" becomes "LOW HIGH | auto".
std::string arguments_of(const DrawingKey& key) {
  std::string arguments;
  for (const char c : key.placeholder)
    arguments += c == '|' ? " | " : c == key.numbers.between && !key.takes_words() ? " " : std::string(1, c);
  return arguments;
}

std::string text_of(const DrawingKey& key, const Drawing& drawing) {
  const DrawingValue value = key.get(drawing);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  Words words;
  for (const double number : std::get<std::vector<double>>(value)) words.push_back(exact(number));
  return join(words, " ");
}

/// "--range is '2:1'; …" becomes "range is '2 1'; …".
std::string in_session_words(std::string message, const DrawingKey& key) {
  const std::string option = key.option();
  if (!message.starts_with(option)) return message;
  if (key.numbers.count > 1) std::ranges::replace(message, ':', ' ');
  return std::string(key.name) + message.substr(option.size());
}

void take_look(Session& session, const DrawingKey& key, const Words& words) {
  if (!words.empty() && (key.is_free_text || key.words.has_formula(words[0])))
    return session.set_look(key, join(words, " "));
  const bool one_word = words.size() == 1 && (key.takes_words() || words[0] == automatic);
  if (!one_word && (key.takes_words() || words.size() != key.numbers.count)) wrong_words(key.name);
  if (!one_word) std::ranges::for_each(words, number);  // throws unless all words are numbers
  session.set_look(key, join(words, std::string_view(&key.numbers.between, 1)));
}

void set_look(Session& session, const DrawingKey& key, const Words& words, const Dialogue& to) {
  try {
    take_look(session, key, words);
  } catch (const UsageError& e) {
    throw UsageError(in_session_words(e.what(), key));
  }
  to.out << key.name << '=' << text_of(key, session.drawing()) << '\n';
}

void view(Session& session, const Words& words, const Dialogue& to) {
  const DrawingKey& key = drawing_key("view");
  const std::string what = words.empty() ? "" : words[0];
  if (what == "pan" && words.size() == 3)
    session.pan(number(words[1]), number(words[2]));
  else if (what == "zoom" && words.size() == 2)
    session.zoom(number(words[1]));
  else if (what == "fit" && words.size() == 1)
    return set_look(session, key, {std::string(automatic)}, to);
  else if (words.size() == key.numbers.count)
    return set_look(session, key, words, to);
  else
    wrong_words("view");
  to.out << key.name << '=' << text_of(key, session.drawing()) << '\n';
}

void orbit(Session& session, const Words& words, const Dialogue& to) {
  if (words.empty() || words.size() > 2) wrong_words("orbit");
  session.orbit(number(words[0]), words.size() == 2 ? number(words[1]) : 0);
  to.out << "camera=" << text_of(drawing_key("camera"), session.drawing()) << '\n';
}

std::string ends(double low, double high) { return fmt::format("{} to {}", brief(low), brief(high)); }

void preview(Session& session, const Words& words, const Dialogue& to) {
  if (!words.empty()) wrong_words("preview");
  const Terminal terminal(to.out);
  Drawing drawing = session.drawing();
  render::Look& look = drawing.look;
  drawing.print_width.clear(), drawing.font_points.reset();
  terminal.adapt(look);
  to.out << terminal.text_of(session.picture(drawing));
  // block characters cannot show texts
  const ColorMeaning colors = meaning(drawing);
  if (look.bare)
    to.out << colors.name << ' ' << (look.range ? ends(look.range->low, look.range->high) : "by colour")
           << ' ' << colors.unit << ", t = " << brief(session.shown().time) << " s, x "
           << ends(look.view->x_min, look.view->x_max) << " m, y " << ends(look.view->y_min, look.view->y_max)
           << " m\n";
}

void frame(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 1) wrong_words("frame");
  // Tab completes any file name
  if (const std::string wrong = png_name(words[0]); !wrong.empty()) throw UsageError(wrong);
  session.frame(words[0]);
  to.out << "file=" << words[0] << '\n';
}

void probe(Session& session, const Words& words, const Dialogue& to) {
  const std::vector<Probe>& probes = session.file().scene.probes;
  std::vector<std::string> names;
  for (const Probe& p : probes) names.push_back(p.name);
  for (const std::string& word : words)
    if (std::ranges::find(names, word) == names.end()) throw UsageError(unknown_name("probe", word, names));
  for (std::size_t k = 0; k < probes.size(); ++k)
    if (words.empty() || std::ranges::find(words, names[k]) != words.end())
      to.out << names[k] << '=' << exact(session.simulation().series().value[k].back()) << '\n';
}

void set(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 1 || words[0].find('=') == std::string::npos) wrong_words("set");
  const Setting setting = parse_setting(words[0]);
  session.set(setting);
  to.out << setting.name << '=' << session.file().find_resolved(setting.name)->value << '\n';
}

void reset(Session& session, const Words& words, const Dialogue& to) {
  if (!words.empty()) wrong_words("reset");
  session.reset();
  say_time(session, to);
}

/// "period=0.25", reference and error, or "period=none" and the reason.
void measures(Session& session, const Words& words, const Dialogue& to) {
  const std::vector<MeasureResult> all = session.measures();
  std::vector<std::string> names;
  for (const MeasureResult& one : all) names.push_back(one.name);
  for (const std::string& word : words)
    if (std::ranges::find(names, word) == names.end()) throw UsageError(unknown_name("measure", word, names));
  for (const MeasureResult& one : all) {
    if (!words.empty() && std::ranges::find(words, one.name) == words.end()) continue;
    to.out << one.name << '=' << (one.value ? exact(*one.value) : "none");
    if (one.reference) to.out << " reference=" << exact(*one.reference);
    if (one.error) to.out << " error=" << exact(*one.error);
    if (!one.value) to.out << " # " << one.why;
    to.out << '\n';
  }
}

/// `names` are probes.
HistoryPlot history_of(const Session& session, const Words& names) {
  const Scene& scene = session.file().scene;
  const Series& series = session.simulation().series();
  const std::size_t rows = series.time.size();
  if (rows < 2) throw UsageError("there is nothing to plot at t = 0; use `run until T` or `step` first");
  const std::string& method = session.file().settings.method;
  HistoryPlot plot{
      .title = scene.title, .scene = scene.name, .columns = {}, .curves = {{method, method, {}}}};
  std::vector<std::vector<double>>& table = plot.curves.front().rows;
  for (const double t : series.time) table.push_back({t});
  for (const std::string& name : names) {
    plot.columns.push_back({name, name, {}, history_unit(name, scene)});
    const std::vector<double>& values = series.value[static_cast<std::size_t>(
        std::ranges::find(scene.probes, name, &Probe::name) - scene.probes.begin())];
    for (std::size_t row = 0; row < rows; ++row) table[row].push_back(values[row]);
  }
  const double now = session.simulation().time();
  for (ReferenceCurve& curve :
       reference_curves(scene, std::string(session.law()), times_in_parts(now, solution_samples))) {
    const auto beyond = std::ranges::upper_bound(curve.t, now) - curve.t.begin();
    curve.t.resize(static_cast<std::size_t>(beyond)), curve.values.resize(curve.t.size());
    if (std::ranges::find(names, curve.column) != names.end() && !curve.t.empty())
      plot.references.push_back(std::move(curve));
  }
  return plot;
}

void plot(Session& session, const Words& words, const Dialogue& to) {
  if (words.empty()) wrong_words("plot");
  const PlotFiles files = plot_files(words[0]);
  const std::vector<Probe>& probes = session.file().scene.probes;
  std::vector<std::string> names;
  for (const Probe& p : probes) names.push_back(p.name);
  if (names.empty()) throw UsageError("the scene has no probes to plot");
  const Words chosen = words.size() == 1 ? names : Words(words.begin() + 1, words.end());
  for (const std::string& word : chosen)
    if (std::ranges::find(names, word) == names.end()) throw UsageError(unknown_name("probe", word, names));
  const HistoryPlot drawn = history_of(session, chosen);
  draw_plot(files, history_script(drawn, files), history_data(drawn));
  to.out << "file=" << words[0] << '\n';
}

void save(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 1) wrong_words("save");
  session.save(words[0]);
  to.out << "file=" << words[0] << '\n';
}

void load(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 1) wrong_words("load");
  session.load(words[0]);
  say_time(session, to);
}

void say_look(const Drawing& drawing, const Dialogue& to) {
  for (const DrawingKey& key : drawing_keys()) {
    if (key.session_help.empty()) continue;
    to.out << key.name << '=' << text_of(key, drawing) << '\n';
  }
}

void info(Session& session, const Words& words, const Dialogue& to) {
  if (!words.empty()) wrong_words("info");
  const SceneFile& file = session.file();
  const Simulation& simulation = session.simulation();
  const Balance sums = balance(simulation.snapshot(), file.scene);
  to.out << "scene=" << file.scene.name << "\nmethod=" << file.settings.method
         << "\nparticles=" << simulation.snapshot().size() << "\nspacing=" << exact(file.scene.spacing)
         << "\nuntil=" << exact(file.scene.until) << "\nt=" << exact(simulation.time())
         << "\nstep=" << simulation.steps() << "\nkinetic_energy=" << exact(sums.kinetic)
         << "\nstrain_energy=" << exact(sums.strain) << '\n';
  say_look(session.drawing(), to);
}

void help(Session&, const Words& words, const Dialogue& to) {
  const std::string name = words.empty() ? "" : find_command(words[0]).name;
  std::vector<std::vector<std::string>> rows;
  for (const SessionCommand& command : session_commands())
    if (words.empty() || command.name == name) rows.push_back({usage(command), command.help});
  to.out << in_columns(rows);
}

void quit(Session&, const Words& words, const Dialogue&) {
  if (!words.empty()) wrong_words("quit");
}

SessionCommand command_of(const DrawingKey& key) {
  const auto run = [&key](Session& session, const Words& words, const Dialogue& to) {
    set_look(session, key, words, to);
  };
  return {std::string(key.name), arguments_of(key), std::string(key.session_help), run};
}

std::vector<SessionCommand> make_commands() {
  std::vector<SessionCommand> all{
      {"step", "[N]", "make N time steps; default: 1", step},
      {"run", "until T", "run to the first step at or after T, s; pictures show the state at T; Ctrl-C stops",
       run},
  };
  for (const DrawingKey& key : drawing_keys())
    if (!key.session_help.empty()) all.push_back(command_of(key));
  SessionCommand& views = *std::ranges::find(all, "view", &SessionCommand::name);
  views.arguments = "pan DX DY | zoom F | fit | X0 X1 Y0 Y1";
  views.run = view;
  all.insert(all.end(),
             {{"orbit", "RIGHT [UPWARDS]", "3D: turn the camera about the scene, degrees", orbit},
              {"preview", "", "show the picture in the terminal", preview},
              {"frame", "FILE.png", "write the picture to a file, as a frame of `taut run`", frame},
              {"probe", "[PROBE ...]", "print the current values of probes; default: all", probe},
              {"plot", "FILE.png [PROBE ...]",
               "plot probes over the time so far, with references; default: all", plot},
              {"measures", "[MEASURE ...]", "print measures of the time so far; default: all", measures},
              {"reset", "", "return to t = 0; settings and drawing options stay", reset},
              {"set", "CONSTANT=VALUE", "change cfl or method.NAME from the next step on", set},
              {"save", "FILE", "save the state, for `load`", save},
              {"load", "FILE", "continue from a saved state", load},
              {"info", "", "print scene, method, time, energies and drawing options", info},
              {"help", "[COMMAND]", "list the commands; ? does the same", help},
              {"quit", "", "end the session; exit and the end of the input do the same", quit}});
  return all;
}

/// Words of a line, empty for a comment. Throws UsageError for an open quote.
Words split(const std::string& line) {
  std::istringstream text(line);
  Words words;
  while (!(text >> std::ws).eof()) {
    const std::string rest = line.substr(static_cast<std::size_t>(text.tellg()));
    if (words.empty() && rest.starts_with('#')) return {};
    if (std::string word; text >> std::quoted(word))
      words.push_back(word);
    else
      throw UsageError(
          fmt::format("the quote is not closed in '{}'; end the text with a quote", shown(rest)));
  }
  return words;
}

}  // namespace

std::span<const SessionCommand> session_commands() {
  static const std::vector<SessionCommand> table = make_commands();
  return table;
}

bool run_session_line(Session& session, const std::string& line, const Dialogue& to) {
  Words words = split(line);
  if (words.empty()) return true;
  const SessionCommand& command = find_command(words[0]);
  words.erase(words.begin());
  command.run(session, words, to);
  return command.name != "quit";
}

}  // namespace taut::cli
