#include "scenario/cue_start.h"

#include <fmt/format.h>

#include <cmath>

#include "physics/motion/cue_stroke.h"

namespace slipcheck {
namespace {

bool check_cue(const WrittenBody& written, const WrittenScene& scene, Reading& reading) {
  const std::size_t faults = reading.faults().size();
  const std::string path = written.path + ".cue";
  if (scene.container) reading.fault_at(path, "is not for a container");
  if (written.extent) reading.fault_at(path, "must strike a sphere");
  if (written.cue->speed && !written.cue->mass)
    reading.fault_at(path, "needs the key mass with speed");
  return reading.faults().size() == faults;
}

/// Where the tip is, which does not slip.
bool check_offset(const CueStroke& stroke, const WrittenBody& written, Reading& reading) {
  const double off = std::hypot(stroke.right, stroke.up) / written.sphere.radius;
  const double most = largest_offset(written.cue->tip_friction);
  if (off <= most * (1 + 1e-12)) return true;
  reading.fault_at(
      written.path + ".cue.offset",
      fmt::format("must be at most {:.4g} R from the centre, here {:.4g} R: beyond that a tip of "
                  "friction {:.4g} slips off the ball",
                  most, off, written.cue->tip_friction));
  return false;
}

}  // namespace

void strike(const WrittenBody& written, const WrittenScene& scene, Body& body, Reading& reading) {
  if (!check_cue(written, scene, reading)) return;
  const Cue& cue = *written.cue;
  const auto length = [&](const Offset& offset) {
    return offset.of_radius ? offset.value * body.sphere.radius : offset.value;
  };
  CueStroke stroke;
  stroke.heading = {std::cos(cue.heading), std::sin(cue.heading)};
  stroke.elevation = cue.elevation;
  stroke.right = length(cue.offset[0]);
  stroke.up = length(cue.offset[1]);
  if (!check_offset(stroke, written, reading) || !(body.sphere.mass > 0)) return;
  const double impulse = cue.impulse
                             ? *cue.impulse
                             : stroke.impulse(body.sphere, *cue.speed, *cue.mass, cue.restitution);
  stroke.strike(body.sphere, impulse, body.initial);
  body.stroke = std::make_shared<Stroke>(impulse, stroke.direction());
}

}  // namespace slipcheck
