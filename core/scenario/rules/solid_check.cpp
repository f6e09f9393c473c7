#include "scenario/rules/solid_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scenario/assemble.h"

namespace slipcheck {
namespace {

/// Between directions and in lengths of a file.
constexpr double kRounding = 1e-12;

std::vector<Vector2> ways_of(const Motion& motion) {
  std::vector<Vector2> ways;
  if (const auto* constant = std::get_if<ConstantMotion>(&motion)) ways = {constant->velocity};
  if (const auto* wave = std::get_if<OscillatingMotion>(&motion)) ways = {wave->amplitude};
  if (const auto* table = std::get_if<TableMotion>(&motion))
    for (std::size_t i = 1; i < table->table.size(); ++i)
      ways.emplace_back(table->table[i].position - table->table[i - 1].position);
  return ways;
}

/// The line along which all of them lie, if they do; x where there are none.
std::optional<Vector2> common_line(const std::vector<Vector2>& ways) {
  std::optional<Vector2> line;
  for (const Vector2& way : ways) {
    const double length = way.norm();
    if (length == 0) continue;
    if (!line) line = way / length;
    if (std::abs(across(*line, way)) > kRounding * length) return std::nullopt;
  }
  return line.value_or(Vector2::UnitX());
}

const WrittenContact* contact_of(const Body& body, const WrittenScene& scene) {
  for (const WrittenContact& contact : scene.contacts)
    if (contact.on_substrate &&
        std::ranges::find(contact.between, body.material) != contact.between.end())
      return &contact;
  return nullptr;
}

/// The largest friction over the normal force that a block can feel. At rest on a still slope it is
/// tan θ, sliding μ_k; on a substrate that moves by itself up to μ_s.
double largest_share(const Body& body, const Substrate& substrate,
                     const SubstrateFriction& friction) {
  const bool shaken = std::holds_alternative<OscillatingMotion>(substrate.motion) ||
                      std::holds_alternative<TableMotion>(substrate.motion);
  if (shaken) return friction.static_;
  const double slope = std::tan(substrate.tilt);
  const Vector2 slip = body.initial.velocity.head<2>() - initial_velocity(substrate.motion);
  const bool slides = !slip.isZero(0) || slope > friction.static_;
  return std::max(slides ? friction.kinetic : 0, std::min(slope, friction.static_));
}

/// A block of height h stays on its face while the friction f F_N at the face, h/2 below the
/// centre, is balanced by a normal force within the face: f h/2 <= l/2 along the friction.
void check_tipping(const WrittenBody& written, const Body& body, const Substrate& substrate,
                   const SubstrateFriction& friction, const std::optional<Vector2>& line,
                   Reading& reading) {
  const double share = largest_share(body, substrate, friction);
  const Vector3& size = body.extent->size;
  for (int k = 0; k < 2; ++k) {
    const double along = line ? std::abs((*line)[k]) : 1;
    if (share * along * size.z() <= size[k] * (1 + kRounding)) continue;
    reading.fault_at(
        fmt::format("{}.block.size[2]", written.path),
        fmt::format("must be at most {:.6g} {}: a block on which friction is {:.4g} of the normal "
                    "force tips where it is higher than {:.4g} times its length along {}",
                    size[k] / (share * along) / to_si(1, kLength, reading.units()),
                    unit_name(kLength, reading.units()), share, 1 / (share * along), "xy"[k]));
    return;
  }
}

void check_block(const WrittenBody& written, const Body& body, Reading& reading) {
  if (!body.initial.angular_velocity.isZero(0))
    reading.fault_at(written.path + ".spin", "must be none for a block, which does not turn");
}

void check_cylinder(const WrittenBody& written, const std::optional<Vector2>& line, Body& body,
                    Reading& reading) {
  if (!line) {
    reading.fault_at(written.path + ".cylinder",
                     "must move along one line, across its axis: its velocity, the slope and the "
                     "substrate's motion have several");
    return;
  }
  const Vector3 axis(-line->y(), line->x(), 0);
  body.extent = std::make_shared<Extent>(body.extent->size, axis.head<2>());
  const Vector3& spin = body.initial.angular_velocity;
  if ((spin - spin.dot(axis) * axis).norm() > kRounding * spin.norm())
    reading.fault_at(written.path + ".spin",
                     "must be about the axis of the cylinder, which lies "
                     "across its way");
}

void check_contact(const WrittenContact& contact, Shape shape, Reading& reading) {
  const RollingLaw& rolling = contact.substrate.rolling;
  const auto& table = rolling.table;
  const bool rolls = std::ranges::any_of(table, [](const auto& p) { return p.second > 0; });
  if (shape == Shape::block && rolls)
    reading.fault_at(contact.path + ".rolling", "must be 0 for a block, which does not roll");
  if (rolling.while_sliding && rolls)
    reading.fault_at(contact.path + ".rolling.while_sliding", "must be false for a cylinder");
  if (contact.substrate.drilling.model != Drilling::Model::none)
    reading.fault_at(contact.path + ".drilling", "must be none for what does not spin");
}

}  // namespace

void check_solid(const WrittenBody& written, const WrittenScene& scene, Body& body,
                 Reading& reading) {
  const bool is_block = body.sphere.shape == Shape::block;
  const std::string path = written.path + (is_block ? ".block" : ".cylinder");
  if (!scene.surfaces.empty()) reading.fault_at(path, "must be a sphere beside surfaces");
  if (!scene.substrate) {
    if (scene.container) reading.fault_at(path, "must be a sphere in a container");
    return;
  }
  if (scene.bodies.size() + scene.fill.size() > 1)
    reading.fault_at(path, "must be the scene's only body: only spheres collide");
  if (body.initial.position.z() != body.sphere.radius)
    reading.fault_at(written.path + ".position", "must lie on the substrate: only spheres fly");
  if (body.initial.velocity.z() != 0)
    reading.fault_at(written.path + ".velocity", "must be horizontal: only spheres fly");
  const Substrate& substrate = *scene.substrate;
  std::vector<Vector2> ways = ways_of(substrate.motion);
  ways.push_back(body.initial.velocity.head<2>());
  if (substrate.tilt > 0) ways.push_back(-Vector2::UnitY());
  if (!is_block) {
    const Vector3& spin = body.initial.angular_velocity;
    ways.emplace_back(spin.y(), -spin.x());
  }
  const std::optional<Vector2> line = common_line(ways);
  const WrittenContact* contact = contact_of(body, scene);
  if (contact) check_contact(*contact, body.sphere.shape, reading);
  if (is_block) {
    check_block(written, body, reading);
    if (contact)
      check_tipping(written, body, substrate, contact->substrate.friction, line, reading);
  } else {
    check_cylinder(written, line, body, reading);
  }
}

}  // namespace slipcheck
