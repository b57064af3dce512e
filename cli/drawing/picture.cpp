#include "cli/drawing/picture.hpp"

#include <algorithm>

#include "cli/drawing/bounds.hpp"

namespace taut::cli {

std::unique_ptr<render::Renderer> make_renderer(const DrawingPlan& plan, double until) {
  render::DrawOptions options{};
  options.width = plan.width;
  options.height = plan.height;
  if (plan.view) options.view = *plan.view;
  options.low = (*plan.range)[0];
  options.high = (*plan.range)[1];
  options.colormap = plan.colormap;
  options.bare = plan.bare;
  options.until = until;
  return std::make_unique<render::Renderer>(options);
}

Picture::Picture(const DrawingPlan& plan, const Captions& captions, const Snapshot& snapshot)
    : value(evaluate(*plan.field, snapshot)) {
  view.dim = snapshot.dim;
  view.time = snapshot.time;
  view.x = snapshot.x;
  view.diameter = snapshot.diameter;
  view.value = value;
  view.field = plan.field->name;
  view.unit = plan.field->unit;
  view.title = captions.title;
  view.method = captions.method;
}

DrawingPlan fitted(DrawingPlan plan, const Snapshot& snapshot) {
  if (plan.range && plan.view) return plan;
  const std::vector<double> value = evaluate(*plan.field, snapshot);
  SequenceBounds bounds;
  bounds.add_values(std::vector<float>(value.begin(), value.end()));
  bounds.add_positions(std::vector<float>(snapshot.x.begin(), snapshot.x.end()), snapshot.dim,
                       std::ranges::max(snapshot.diameter));
  if (!plan.range) plan.range = bounds.range(plan.field->is_signed);
  if (!plan.view) plan.view = bounds.view();
  return plan;
}

render::Image draw_picture(const DrawingPlan& plan, const Captions& captions, const Snapshot& snapshot) {
  const DrawingPlan whole = fitted(plan, snapshot);
  const Picture picture(whole, captions, snapshot);
  return make_renderer(whole, captions.until)->draw(picture.view);
}

}  // namespace taut::cli
