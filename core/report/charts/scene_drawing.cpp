#include "report/charts/scene_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "report/html/html_text.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

// In the drawing's own pixels.
constexpr double kWidth = 440;
constexpr double kTallest = 240;
constexpr double kMargin = 22;         // for names
constexpr double kSmallestRadius = 2;  // what is smaller is drawn so, and hollow
constexpr std::size_t kMostNames = 30;
constexpr std::size_t kMostDescribed = 6;
constexpr std::size_t kMostDrawn = 500;  // of more a part is

bool is_seen_from_side(const Scenario& scenario) {
  if (std::holds_alternative<Container>(scenario.surroundings)) return true;
  return std::any_of(scenario.bodies.begin(), scenario.bodies.end(), [](const Body& body) {
    const bool above = body.initial.position.z() > body.sphere.radius * (1 + 1e-9);
    return above || body.initial.velocity.z() != 0;
  });
}

Vector2 seen(const Vector3& v, bool from_side) {
  return from_side ? Vector2(v.x(), v.z()) : v.head<2>();
}

/// The bodies that are drawn: all, or of many those in the middle of where they are, in a part of
/// the same shape as the whole.
std::vector<const Body*> drawn_bodies(const Scenario& scenario, bool from_side) {
  std::vector<const Body*> drawn;
  drawn.reserve(scenario.bodies.size());
  for (const Body& body : scenario.bodies) drawn.push_back(&body);
  if (drawn.size() <= kMostDrawn) return drawn;
  const auto place = [&](const Body* body) { return seen(body->initial.position, from_side); };
  Vector2 middle, extent;
  for (int k = 0; k < 2; ++k) {
    const auto along = [&](const Body* body) { return place(body)[k]; };
    const auto median = drawn.begin() + static_cast<std::ptrdiff_t>(drawn.size() / 2);
    std::ranges::nth_element(drawn, median, {}, along);
    middle[k] = along(*median);
    const auto [low, high] = std::ranges::minmax(drawn, {}, along);
    extent[k] = std::max(along(high) - along(low), 1e-300);
  }
  const auto last = drawn.begin() + kMostDrawn;
  std::ranges::nth_element(drawn, last, {}, [&](const Body* body) {
    return (place(body) - middle).cwiseQuotient(extent).cwiseAbs().maxCoeff();
  });
  drawn.erase(last, drawn.end());
  return drawn;
}

/// From the scene [m] to the drawing, y downwards.
class View {
 public:
  explicit View(const Scenario& scenario)
      : from_side_(is_seen_from_side(scenario)), bodies_(drawn_bodies(scenario, from_side_)) {
    double fastest = 0;
    Vector2 low = Vector2::Constant(INFINITY), high = -low;
    const auto cover = [&](const Vector2& point, double around) {
      low = low.cwiseMin(point - Vector2::Constant(around));
      high = high.cwiseMax(point + Vector2::Constant(around));
    };
    for (const Body* body : bodies_) {
      fastest = std::max(fastest, seen(body->initial.velocity).norm());
      cover(seen(body->initial.position), body->sphere.radius);
    }
    if (bodies_.size() == scenario.bodies.size()) cover_surroundings(scenario, low, high, cover);
    // The fastest body's arrow is a quarter of the balls' extent; of many, what lies between two.
    const double many = 1 / std::sqrt(static_cast<double>(bodies_.size()));
    const double longest = bodies_.size() > kMostNames ? std::min(0.05, many) : 0.25;
    if (fastest > 0) arrow_time_ = longest * (high - low).maxCoeff() / fastest;
    for (const Body* body : bodies_)
      cover(seen(body->initial.position) + arrow_time_ * seen(body->initial.velocity), 0);
    const Vector2 extent = high - low;
    scale_ = std::min((kWidth - 2 * kMargin) / extent.x(), (kTallest - 2 * kMargin) / extent.y());
    height_ = std::max(extent.y() * scale_ + 2 * kMargin, 90.0);
    origin_ = Vector2(0.5 * kWidth, 0.5 * height_) -
              scale_ * Vector2(0.5 * (low.x() + high.x()), -0.5 * (low.y() + high.y()));
  }

  bool from_side() const { return from_side_; }
  const std::vector<const Body*>& bodies() const { return bodies_; }  ///< that are drawn
  double height() const { return height_; }
  double scale() const { return scale_; }  ///< pixels for one metre
  Vector2 place(const Vector3& position) const { return origin_ + flipped(seen(position)); }
  Vector2 arrow(const Vector3& velocity) const { return arrow_time_ * flipped(seen(velocity)); }

 private:
  template <class Cover>
  void cover_surroundings(const Scenario& scenario, const Vector2& low, const Vector2& high,
                          const Cover& cover) const {
    if (from_side_) cover(Vector2(0.5 * (low.x() + high.x()), 0), 0);
    if (const auto* box = std::get_if<Container>(&scenario.surroundings)) {
      cover(Vector2(0, -box->floor_amplitude), 0);
      cover(Vector2(box->width, box->floor_amplitude), 0);
      if (box->height) cover(Vector2(0, *box->height), 0);
    }
    if (const auto* plane = std::get_if<Substrate>(&scenario.surroundings);
        plane && plane->periodic && !from_side_) {
      cover(Vector2::Zero(), 0);
      cover(*plane->periodic, 0);
    }
  }
  Vector2 seen(const Vector3& v) const { return slipcheck::seen(v, from_side_); }
  Vector2 flipped(const Vector2& v) const { return scale_ * Vector2(v.x(), -v.y()); }

  bool from_side_;
  std::vector<const Body*> bodies_;
  double arrow_time_ = 0;
  double scale_ = 1;
  double height_ = 0;
  Vector2 origin_ = Vector2::Zero();
};

std::string arrow(const Vector2& from, const Vector2& along) {
  const double length = along.norm();
  if (length < 3) return {};
  const Vector2 tip = from + along, unit = along / length, across(-unit.y(), unit.x());
  const double head = std::min(9.0, 0.5 * length);
  const Vector2 neck = tip - head * unit, a = neck + 0.45 * head * across,
                b = neck - 0.45 * head * across;
  return fmt::format(
      "<path class=\"arrow\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>"
      "<path class=\"arrow-head\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\"/>",
      from.x(), from.y(), neck.x(), neck.y(), tip.x(), tip.y(), a.x(), a.y(), b.x(), b.y());
}

std::string ball(const View& view, const Body& body, bool with_name) {
  const Vector2 at = view.place(body.initial.position);
  const double radius = view.scale() * body.sphere.radius;
  const double drawn = std::max(radius, kSmallestRadius);
  std::string svg =
      fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>",
                  radius < kSmallestRadius ? "ball small" : "ball", at.x(), at.y(), drawn);
  svg += arrow(at, view.arrow(body.initial.velocity));
  if (with_name) {
    const double width = 8 * static_cast<double>(body.name.size());
    const bool inside = 2 * drawn > width && body.initial.velocity.isZero();
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", at.x(),
                       inside ? at.y() + 4 : at.y() - drawn - 5, escaped(body.name));
  }
  return svg + "\n";
}

/// A bar of a round length at the lower left.
std::string scale_bar(const View& view) {
  const double longest = 90 / view.scale();
  const double decade = std::pow(10.0, std::floor(std::log10(longest)));
  const double length = longest >= 5 * decade   ? 5 * decade
                        : longest >= 2 * decade ? 2 * decade
                                                : decade;
  const double y = view.height() - 7, end = 8 + length * view.scale();
  const QuantityFormat format(length, kLength);
  return fmt::format(
      "<path class=\"bar\" d=\"M8 {0:.1f}v4h{1:.1f}v-4\"/><text class=\"bar-text\" x=\"{2:.1f}\" "
      "y=\"{3:.1f}\">{4} {5}</text>\n",
      y - 4, end - 8, end + 6, y + 2, plain_number(length / format.factor()), format.unit());
}

std::string range(double low, double high, const Dimension& dimension) {
  const QuantityFormat format(high, dimension, 3);
  return format.number(low) == format.number(high)
             ? format.text(high)
             : format.number(low) + " to " + format.text(high);
}

std::string caption(const Scenario& scenario, const View& view) {
  std::string text =
      view.from_side() ? "At the start, seen from the side." : "At the start, seen from above.";
  const std::vector<Body>& bodies = scenario.bodies;
  if (bodies.size() <= kMostDescribed) {
    for (const Body& body : bodies) {
      text +=
          fmt::format(" {}: R = {}, m = {}", body.name, quantity(body.sphere.radius, kLength, 3),
                      quantity(body.sphere.mass, kMass, 3));
      if (const double speed = body.initial.velocity.norm(); speed > 0)
        text += fmt::format(", v = {}", quantity(speed, kVelocity, 3));
      if (const double spin = body.initial.angular_velocity.norm(); spin > 0)
        text += fmt::format(", Ω = {}", quantity(spin, kAngularVelocity, 3));
      text += ".";
    }
  } else {
    double small = INFINITY, large = 0, fastest = 0;
    for (const Body& body : bodies) {
      small = std::min(small, body.sphere.radius);
      large = std::max(large, body.sphere.radius);
      fastest = std::max(fastest, body.initial.velocity.norm());
    }
    text += fmt::format(" {} bodies, R = {}, the fastest at {}.", bodies.size(),
                        range(small, large, kLength), quantity(fastest, kVelocity, 3));
    if (view.bodies().size() < bodies.size())
      text += fmt::format(" Drawn are {} in their middle.", view.bodies().size());
  }
  return text;
}

/// How far the floor swings: thin lines at its lowest and its highest.
std::string swing_of_floor(const Container& box, const View& view) {
  std::string svg;
  for (const double z : {-box.floor_amplitude, box.floor_amplitude}) {
    const Vector2 from = view.place(Vector3(0, 0, z)), to = view.place(Vector3(box.width, 0, z));
    svg += fmt::format("M{:.1f} {:.1f}H{:.1f}", from.x(), from.y(), to.x());
  }
  return fmt::format("<path class=\"sway\" d=\"{}\"/>\n", svg);
}

/// The periodic cell in whose lower left corner the scene's origin lies.
std::string cell_of(const Scenario& scenario, const View& view) {
  const auto* substrate = std::get_if<Substrate>(&scenario.surroundings);
  if (!substrate || !substrate->periodic || view.from_side()) return {};
  const Vector2 lengths = *substrate->periodic;
  const Vector2 from = view.place(Vector3::Zero());
  const Vector2 to = view.place(Vector3(lengths.x(), lengths.y(), 0));
  return fmt::format("<path class=\"cell\" d=\"M{0:.1f} {1:.1f}H{2:.1f}V{3:.1f}H{0:.1f}Z\"/>\n",
                     from.x(), from.y(), to.x(), to.y());
}

std::string surroundings(const Scenario& scenario, const View& view) {
  const double left = view.place(Vector3::Zero()).x(), ground = view.place(Vector3::Zero()).y();
  if (const auto* box = std::get_if<Container>(&scenario.surroundings)) {
    const double top = box->height ? ground - view.scale() * *box->height : 0;
    const double right = left + view.scale() * box->width;
    const bool swings = box->floor_amplitude > 0 && box->floor_frequency > 0;
    return fmt::format(
               "<path class=\"ground\" d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}V{1:.1f}{4}\"/>\n", left,
               std::max(top, 0.0), ground, right, box->height ? "Z" : "") +
           (swings ? swing_of_floor(*box, view) : "");
  }
  if (!view.from_side()) return cell_of(scenario, view);
  return fmt::format("<path class=\"ground\" d=\"M0 {0:.1f}H{1}\"/>\n", ground, kWidth);
}

}  // namespace

std::string scene_drawing(const Scenario& scenario) {
  if (scenario.bodies.empty()) return {};
  const View view(scenario);
  const std::string text = escaped(caption(scenario, view));
  std::string html = fmt::format(
      "<figure class=\"drawing\"><svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
      kWidth, view.height(), text);
  html += surroundings(scenario, view);
  for (const Body* body : view.bodies())
    html += ball(view, *body, view.bodies().size() <= kMostNames);
  return html + scale_bar(view) + "</svg><figcaption>" + text + "</figcaption></figure>\n";
}

}  // namespace slipcheck
