#include "cli/session/session_commands.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "cli/session/terminal.hpp"
#include "cli/text/format.hpp"
#include "cli/text/unknown_name.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Words = std::vector<std::string>;

const SessionCommand& find_command(const std::string& name) {
  const auto all = session_commands();
  const auto found = std::ranges::find(all, name, &SessionCommand::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const SessionCommand& command : all) names.emplace_back(command.name);
  throw UsageError(unknown_name("command", name, names));
}

std::string usage(const SessionCommand& command) {
  return std::string(command.name) + (command.arguments.empty() ? "" : " ") + std::string(command.arguments);
}

[[noreturn]] void wrong_words(const char* name) { throw UsageError("usage: " + usage(find_command(name))); }

double number(const std::string& word) {
  const auto value = parsed<double>(word);
  if (!value || !std::isfinite(*value)) throw UsageError("'" + word + "' is not a number");
  return *value;
}

void say_time(const Session& session, const Dialogue& to) {
  to.out << "t=" << exact(session.simulation().time()) << " step=" << session.simulation().steps() << '\n';
}

void step(Session& session, const Words& words, const Dialogue& to) {
  constexpr double most = 1e9;
  if (words.size() > 1) wrong_words("step");
  const double count = words.empty() ? 1 : number(words[0]);
  if (count < 1 || count > most || count != std::floor(count))
    throw UsageError("step takes a whole number from 1 to a billion, not '" + words[0] + "'");
  session.step(static_cast<long>(count), to.interrupts);
  say_time(session, to);
}

void run(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 2 || words[0] != "until") wrong_words("run");
  session.run_until(number(words[1]), to.interrupts, to.progress);
  say_time(session, to);
}

void color(Session& session, const Words& words, const Dialogue&) {
  if (words.size() != 1) wrong_words("color");
  DrawingOptions options;
  options.color = words[0];
  session.draw_with(options);
}

void range(Session& session, const Words& words, const Dialogue&) {
  DrawingOptions options;
  if (words.size() == 1 && words[0] == "auto")
    options.range = words[0];
  else if (words.size() == 2)
    options.range = words[0] + ":" + words[1];
  else
    wrong_words("range");
  session.draw_with(options);
}

void colormap(Session& session, const Words& words, const Dialogue&) {
  if (words.size() != 1) wrong_words("colormap");
  DrawingOptions options;
  options.colormap = words[0];
  session.draw_with(options);
}

void view(Session& session, const Words& words, const Dialogue&) {
  const std::string what = words.empty() ? "" : words[0];
  DrawingOptions options;
  if (what == "pan" && words.size() == 3) {
    session.pan(number(words[1]), number(words[2]));
  } else if (what == "zoom" && words.size() == 2) {
    session.zoom(number(words[1]));
  } else if (what == "fit" && words.size() == 1) {
    options.view = "auto";
    session.draw_with(options);
  } else if (words.size() == 4) {
    options.view = join(words, ":");
    session.draw_with(options);
  } else {
    wrong_words("view");
  }
}

std::string ends(double low, double high) { return brief(low) + " to " + brief(high); }

void preview(Session& session, const Words& words, const Dialogue& to) {
  if (!words.empty()) wrong_words("preview");
  const Terminal terminal(to.out);
  DrawingPlan plan = session.look();
  terminal.suit(plan);
  to.out << terminal.text_of(session.picture(plan));
  // texts in a picture of characters could not be read
  if (plan.bare)
    to.out << plan.field->name << ' ' << ends((*plan.range)[0], (*plan.range)[1]) << ' ' << plan.field->unit
           << ", t = " << brief(session.simulation().time()) << " s, x "
           << ends(plan.view->x_min, plan.view->x_max) << " m, y " << ends(plan.view->y_min, plan.view->y_max)
           << " m\n";
}

void frame(Session& session, const Words& words, const Dialogue& to) {
  if (words.size() != 1) wrong_words("frame");
  // a slip of the completion would cost the file that it names
  if (!words[0].ends_with(".png")) throw UsageError("'" + words[0] + "' does not end in .png");
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

void set(Session& session, const Words& words, const Dialogue&) {
  if (words.size() != 1 || words[0].find('=') == std::string::npos) wrong_words("set");
  session.set(parse_setting(words[0]));
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

/// In the words of the commands that change it.
void say_look(const DrawingPlan& plan, const Dialogue& to) {
  const auto& [low, high] = *plan.range;
  const render::View& view = *plan.view;
  to.out << "color=" << plan.field->key << "\nrange=" << exact(low) << ' ' << exact(high)
         << "\ncolormap=" << plan.colormap->key << "\nview=" << exact(view.x_min) << ' ' << exact(view.x_max)
         << ' ' << exact(view.y_min) << ' ' << exact(view.y_max) << '\n';
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
  say_look(session.look(), to);
}

void help(Session&, const Words& words, const Dialogue& to) {
  std::vector<std::vector<std::string>> rows;
  for (const SessionCommand& command : session_commands())
    if (words.empty() || command.name == words[0])
      rows.push_back({usage(command), std::string(command.help)});
  if (rows.empty()) find_command(words[0]);  // says which names there are
  to.out << in_columns(rows);
}

void quit(Session&, const Words& words, const Dialogue&) {
  if (!words.empty()) wrong_words("quit");
}

constexpr SessionCommand table[] = {
    {"step", "[N]", "N steps, or one", step},
    {"run", "until T", "to the first step at or past T seconds; Ctrl-C stops it", run},
    {"color", "FIELD", "the field to colour by (`taut list fields`)", color},
    {"range", "LOW HIGH | auto", "of the colours, in the field's unit; auto: of the moment", range},
    {"colormap", "COLORMAP", "`taut list colormaps`", colormap},
    {"view", "pan DX DY | zoom F | fit | X0 X1 Y0 Y1", "what is seen, m; fit: all particles of the moment",
     view},
    {"preview", "", "shows the picture in the terminal", preview},
    {"frame", "FILE.png", "draws what `preview` shows into a file, as `taut run` does", frame},
    {"probe", "[PROBE ...]", "the values of probes now", probe},
    {"set", "CONSTANT=VALUE", "cfl, or method.NAME, from the next step on", set},
    {"save", "FILE", "the state, for `load`", save},
    {"load", "FILE", "goes on from a saved state", load},
    {"info", "", "scene, method, time, energies, how frames look", info},
    {"help", "[COMMAND]", "this list", help},
    {"quit", "", "ends the session, as the end of the input does", quit},
};

}  // namespace

std::span<const SessionCommand> session_commands() { return table; }

bool run_session_line(Session& session, const std::string& line, const Dialogue& to) {
  std::istringstream text(line);
  Words words;
  for (std::string word; text >> std::quoted(word);) words.push_back(word);
  if (words.empty() || words[0].starts_with('#')) return true;
  const SessionCommand& command = find_command(words[0]);
  words.erase(words.begin());
  command.run(session, words, to);
  return command.run != quit;
}

}  // namespace taut::cli
