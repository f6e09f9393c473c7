#include <utility>

#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

/// Of a direction only where it points to.
Rule<Vector3> direction_rule() {
  const Rule<Vector3> any = triple_of(kPureNumber, kAnyNumber);
  return {[any](const YamlNode& node, Reading& reading, Vector3& target) {
            if (!any.read(node, reading, target)) return false;
            const double length = target.norm();
            if (length > 0) {
              target /= length;
              return true;
            }
            reading.fault(node, "must not be zero");
            return false;
          },
          any.schema};
}

Rule<SurfaceShape> plane_rule() {
  Record<PlaneShape> plane;
  plane.key("point", &PlaneShape::point, triple_of(kLength, kAnyNumber), required, "any of it")
      .key("normal", &PlaneShape::normal, direction_rule(), required,
           "to the side on which bodies are, of any length");
  return as_alternative<SurfaceShape>(plane.rule());
}

/// A rectangle as it is written: from the middle of one edge to that of the opposite one.
struct WrittenPlate {
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();
  std::optional<double> width;
  std::optional<Vector3> across;
};

Rule<SurfaceShape> rectangle_rule() {
  Record<WrittenPlate> plate;
  plate
      .key("from", &WrittenPlate::from, triple_of(kLength, kAnyNumber), required,
           "middle of an edge")
      .key("to", &WrittenPlate::to, triple_of(kLength, kAnyNumber), required,
           "middle of the opposite edge")
      .key("width", &WrittenPlate::width, number(kLength, kPositive), optional,
           "of these edges, which are level")
      .key("across", &WrittenPlate::across, triple_of(kLength, kAnyNumber), optional,
           "in place of width: such an edge as a vector")
      .exactly_one_of({"width", "across"});
  const Rule<WrittenPlate> rule = plate.rule();
  return {[rule](const YamlNode& node, Reading& reading, SurfaceShape& target) {
            WrittenPlate written;
            if (!rule.read(node, reading, written)) return false;
            const Vector3 length = written.to - written.from;
            if (length.isZero(0)) {
              reading.fault(node, "must lead to another place than where it begins");
              return false;
            }
            Vector3 across;
            if (written.width) {
              const Vector3 level = kUp.cross(length);
              if (level.norm() <= 1e-12 * length.norm()) {
                reading.fault(node, "must have across in place of width, as it leads straight up");
                return false;
              }
              across = *written.width * level.normalized();
            } else {
              across = *written.across;
              if (!(across.norm() > 0) ||
                  std::abs(across.dot(length)) > 1e-9 * across.norm() * length.norm()) {
                reading.fault(node, "must have across at right angles to the way from from to to");
                return false;
              }
            }
            target = RectangleShape{0.5 * (written.from + written.to), 0.5 * length, 0.5 * across};
            return true;
          },
          rule.schema};
}

Rule<SurfaceShape> cylinder_rule() {
  Record<RodShape> rod;
  rod.key("from", &RodShape::begin, triple_of(kLength, kAnyNumber), required, "end of its axis")
      .key("to", &RodShape::end, triple_of(kLength, kAnyNumber), required, "the other end")
      .key("radius", &RodShape::radius, number(kLength, kPositive), required, "of the cylinder");
  const Rule<RodShape> rule = rod.rule();
  return {[rule](const YamlNode& node, Reading& reading, SurfaceShape& target) {
            RodShape& read = target.emplace<RodShape>();
            if (!rule.read(node, reading, read)) return false;
            if (read.begin != read.end) return true;
            reading.fault(node, "must lead to another place than where it begins");
            return false;
          },
          rule.schema};
}

Rule<SurfaceShape> ball_rule() {
  Record<BallShape> ball;
  ball.key("centre", &BallShape::centre, triple_of(kLength, kAnyNumber), required, "its centre")
      .key("radius", &BallShape::radius, number(kLength, kPositive), required, "R");
  return as_alternative<SurfaceShape>(ball.rule());
}

Rule<BoxOfPlates> box_rule() {
  using Side = BoxOfPlates::Side;
  std::vector<std::pair<std::string, Side>> sides;
  for (std::size_t k = 0; k < kNamesOf<Side>.size(); ++k)
    sides.emplace_back(kNamesOf<Side>[k], static_cast<Side>(k));
  const Rule<Side> side = choice<Side>(sides);
  Record<BoxOfPlates> box;
  box.key("from", &BoxOfPlates::from, triple_of(kLength, kAnyNumber), required,
          "its corner with the least x, y and z")
      .key("to", &BoxOfPlates::to, triple_of(kLength, kAnyNumber), required,
           "that with the largest")
      .key("open", &BoxOfPlates::open,
           one_form_of<std::vector<Side>>(
               "must be a side or a list of them",
               {{[](const YamlNode& node) { return is_list(node); }, list(side, 0, 5)},
                {is_scalar, made_from<std::vector<Side>>(
                                side, [](Side one) { return std::vector<Side>{one}; })}}),
           optional, "sides without a plate");
  const Rule<BoxOfPlates> rule = box.rule();
  return {[rule](const YamlNode& node, Reading& reading, BoxOfPlates& target) {
            if (!rule.read(node, reading, target)) return false;
            if ((target.to - target.from).minCoeff() > 0) return true;
            reading.fault(node, "must have to above from in x, y and z");
            return false;
          },
          rule.schema};
}

Rule<SurfaceMotionModel> surface_motion_rule() {
  const Rule<Vector3> velocity = triple_of(kVelocity, kAnyNumber);
  Record<BeltMotion> belt;
  belt.key("velocity", &BeltMotion::velocity, velocity, required, "[x, y, z], along the surface");
  Record<SurfaceTranslation> constant;
  constant.key("velocity", &SurfaceTranslation::velocity, velocity, required, "[x, y, z]");
  Record<SurfaceOscillation> oscillate;
  oscillate
      .key("amplitude", &SurfaceOscillation::amplitude, triple_of(kLength, kAnyNumber), required,
           "[x, y, z]")
      .key("frequency", &SurfaceOscillation::frequency, number(kFrequency, kPositive), required,
           "in cycles per second")
      .key("phase", &SurfaceOscillation::phase, number(kAngle, kAnyNumber), optional,
           "of the sine at time 0");
  Record<SurfaceTurning> turn;
  turn.key("about", &SurfaceTurning::about, triple_of(kLength, kAnyNumber), required,
           "a point of the axis")
      .key("rate", &SurfaceTurning::rate, triple_of(kAngularVelocity, kAnyNumber), required,
           "angular velocity [ωx, ωy, ωz], around itself");
  using Model = SurfaceMotionModel;
  return one_of<Model>(
      "kind", {alternative<Model>("still", "does not move", Record<StillMotion>()),
               alternative<Model>("belt", "its matter passes by, its shape stays", belt),
               alternative<Model>("constant", "constant velocity", constant),
               alternative<Model>("oscillate", "amplitude sin(2π frequency t + phase)", oscillate),
               alternative<Model>("turn", "about an axis", turn)});
}

Rule<WrittenSurface> surface_rule() {
  using Shape = decltype(WrittenSurface::shape);
  const auto shape = [](auto rule) {
    return Rule<WrittenSurface>{
        [rule](const YamlNode& node, Reading& reading, WrittenSurface& target) {
          typename decltype(rule)::Value read{};
          if (!rule.read(node, reading, read)) return false;
          target.shape = Shape(std::move(read));
          return true;
        },
        rule.schema};
  };
  Record<WrittenSurface> surface;
  surface
      .key("name", &WrittenSurface::name, name_text(NameStyle::any_case), required,
           "unique in the scene, as a body's")
      .key("material", &WrittenSurface::material, name_text(NameStyle::any_case), required,
           "one of the materials")
      .whole("plane", shape(plane_rule()), optional, "everything behind it is solid")
      .whole("rectangle", shape(rectangle_rule()), optional, "a plate without thickness")
      .whole("cylinder", shape(cylinder_rule()), optional, "a solid one with flat ends")
      .whole("sphere", shape(ball_rule()), optional, "a fixed one")
      .whole("box", shape(box_rule()), optional,
             "plates around a space, NAME-left (least x), -right, -front (least y), -back, "
             "-bottom and -top")
      .key("motion", &WrittenSurface::motion, surface_motion_rule(), optional, "of the surface")
      .exactly_one_of({"plane", "rectangle", "cylinder", "sphere", "box"});
  return placed(surface.rule());
}

}  // namespace

Rule<std::vector<WrittenSurface>> surfaces_rule() { return list(surface_rule(), 1); }

}  // namespace slipcheck
