#include <utility>

#include "scenario/presets.h"
#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

constexpr std::int64_t kMostBodies = 1'000'000;
constexpr std::int64_t kLargestSeed = std::int64_t{1} << 53;  // exact as a double

/// q of I = q m R². No mass lies further from the axis than R: I = ∫ r² dm <= m R².
Rule<double> inertia_rule() {
  const auto shape =
      choice<double>({{"solid", 2.0 / 5}, {"shell", 2.0 / 3}, {"disk", 1.0 / 2}, {"ring", 1.0}});
  return one_form_of<double>("must be solid, shell, disk, ring or a number in (0, 1]",
                             {{[](const YamlNode& node) {
                                 return is_scalar(node) && node.text[0] >= 'a' &&
                                        node.text[0] <= 'z';
                               },
                               shape},
                              {is_scalar, number(kPureNumber, {{}, 0, 1, {}})}});
}

Rule<WrittenSpin> spin_rule() {
  const auto kinds = choice<SpinKind>({{"none", SpinKind::none}, {"rolling", SpinKind::rolling}});
  const auto named = made_from<WrittenSpin>(kinds, [](SpinKind kind) {
    return WrittenSpin{kind, {}};
  });
  return one_form_of<WrittenSpin>(
      "must be none, rolling, [ωx, ωy, ωz] or, in a container, a number",
      {{is_word("none"), named},
       {is_word("rolling"), named},
       {[](const YamlNode& node) { return is_list(node); },
        made_from<WrittenSpin>(numbers(kAngularVelocity, kAnyNumber, {3}),
                               [](std::vector<double> values) {
                                 return WrittenSpin{SpinKind::given, std::move(values)};
                               })},
       {is_scalar, made_from<WrittenSpin>(number(kAngularVelocity, kAnyNumber), [](double about_y) {
          return WrittenSpin{SpinKind::given, {about_y}};
        })}});
}

/// Half of what stands there, for a diameter.
template <class T>
Rule<T> half(double T::*radius) {
  const Rule<double> diameter = number(kLength, kPositive);
  return {[=](const YamlNode& node, Reading& reading, T& target) {
            if (!diameter.read(node, reading, target.*radius)) return false;
            target.*radius /= 2;
            return true;
          },
          diameter.schema};
}

Rule<Sphere> sphere_rule() {
  Record<Sphere> sphere;
  sphere.key("radius", &Sphere::radius, number(kLength, kPositive), optional, "R")
      .whole("diameter", half(&Sphere::radius), optional, "2 R, in place of radius")
      .key("inertia", &Sphere::shape_factor, inertia_rule(), optional,
           "solid, shell, disk, ring or the factor q in I = q m R²")
      .whole("preset", preset_rule<Sphere>(PresetPart::sphere), optional,
             "brings what does not stand here, and the body's mass")
      .exactly_one_of({"radius", "diameter"}, or_preset);
  return sphere.rule();
}

/// The centre of mass of a homogeneous block is half its height above the plane, and its moment of
/// inertia about the vertical is m (x² + y²)/12.
Rule<WrittenBody> block_rule() {
  struct Block {
    std::vector<double> size;
  };
  Record<Block> record;
  record.key("size", &Block::size, numbers(kLength, kPositive, {3}), required,
             "[x, y, z] lengths of its edges, z its height");
  const Rule<Block> block = record.rule();
  return {[block](const YamlNode& node, Reading& reading, WrittenBody& body) {
            Block read;
            if (!block.read(node, reading, read)) return false;
            const Vector3 size(read.size[0], read.size[1], read.size[2]);
            const double half_height = size.z() / 2;
            body.sphere.radius = half_height;
            body.sphere.shape_factor =
                size.head<2>().squaredNorm() / (12 * half_height * half_height);
            body.sphere.shape = Shape::block;
            body.extent = Extent{size, Vector2::UnitX()};
            return true;
          },
          block.schema};
}

Rule<WrittenBody> cylinder_rule() {
  struct Cylinder {
    double radius = 0, length = 0;
  };
  Record<Cylinder> record;
  record.key("radius", &Cylinder::radius, number(kLength, kPositive), optional, "R")
      .whole("diameter", half(&Cylinder::radius), optional, "2 R, in place of radius")
      .key("length", &Cylinder::length, number(kLength, kPositive), required, "along its axis")
      .exactly_one_of({"radius", "diameter"});
  const Rule<Cylinder> cylinder = record.rule();
  return {[cylinder](const YamlNode& node, Reading& reading, WrittenBody& body) {
            Cylinder read;
            if (!cylinder.read(node, reading, read)) return false;
            body.sphere = {read.radius, 0, 1.0 / 2, Shape::cylinder};
            body.extent = Extent{{read.length, 2 * read.radius, 2 * read.radius}, Vector2::UnitX()};
            return true;
          },
          cylinder.schema};
}

Rule<WrittenBody> body_rule() {
  Record<WrittenBody> body;
  body.key("name", &WrittenBody::name, name_text(NameStyle::any_case), required,
           "unique in the scene")
      .key("material", &WrittenBody::material, name_text(NameStyle::any_case), required,
           "one of the materials")
      .key("sphere", &WrittenBody::sphere, sphere_rule(), optional, "its shape")
      .whole("block", block_rule(), optional, "its shape: slides on a face; an extension")
      .whole("cylinder", cylinder_rule(), optional,
             "its shape: lies on its side and moves across its axis; an extension")
      .key("mass", &WrittenBody::mass, number(kMass, kPositive), optional,
           "in place of the material's density")
      .key("position", &WrittenBody::position, numbers(kLength, kAnyNumber, {2, 3}), required,
           "of the centre: [x, y] at rest on the substrate, [x, y, z], or [x, z] in a container")
      .key("on", &WrittenBody::on, name_text(NameStyle::any_case), optional,
           "a surface: the position is moved along its normal until the body touches it")
      .key("velocity", &WrittenBody::velocity, numbers(kVelocity, kAnyNumber, {2, 3}), optional,
           "of the centre: [x, y], [x, y, z], or [x, z] in a container")
      .key("spin", &WrittenBody::spin, spin_rule(), optional, "angular velocity")
      .key("cue", &WrittenBody::cue, cue_rule(), optional,
           "in place of velocity and spin: what strikes a sphere at rest; an extension")
      .exactly_one_of({"sphere", "block", "cylinder"})
      .at_most_one_of({"cue", "velocity"})
      .at_most_one_of({"cue", "spin"});
  return placed(body.rule());
}

Rule<Fill> volume_rule() {
  const Rule<std::vector<double>> corners = numbers(kLength, kAnyNumber, {6});
  return {[corners](const YamlNode& node, Reading& reading, Fill& target) {
            std::vector<double> read;
            if (!corners.read(node, reading, read)) return false;
            target.area = {read[0], read[1], read[3], read[4]};
            target.heights = Vector2(read[2], read[5]);
            if (read[0] <= read[3] && read[1] <= read[4] && read[2] <= read[5]) return true;
            reading.fault(node, "must have x0 <= x1, y0 <= y1 and z0 <= z1");
            return false;
          },
          corners.schema};
}

Rule<Fill> one_fill_rule() {
  const Rule<double> length = number(kLength, kPositive);
  const Rule<Fill> one_radius = {[length](const YamlNode& node, Reading& reading, Fill& target) {
                                   if (!length.read(node, reading, target.least_radius))
                                     return false;
                                   target.most_radius = target.least_radius;
                                   return true;
                                 },
                                 length.schema};
  const Rule<std::vector<double>> limits = numbers(kLength, kPositive, {2});
  const Rule<Fill> two_radii = {[limits](const YamlNode& node, Reading& reading, Fill& target) {
                                  std::vector<double> radii;
                                  if (!limits.read(node, reading, radii)) return false;
                                  target.least_radius = radii[0];
                                  target.most_radius = radii[1];
                                  if (radii[0] <= radii[1]) return true;
                                  reading.fault(node, "must have the smaller radius first");
                                  return false;
                                },
                                limits.schema};
  Record<Fill> uniform;
  uniform.whole("uniform", two_radii, required, "smallest and largest radius");

  Record<Fill> fill;
  fill.key("prefix", &Fill::prefix, name_text(NameStyle::any_case), required,
           "of the names, which end with 1, 2, …")
      .key("count", &Fill::count, integer(1, kMostBodies), required, "number of bodies")
      .key("material", &Fill::material, name_text(NameStyle::any_case), required,
           "one of the materials")
      .whole("radius",
             one_form_of<Fill>("must be a length or {uniform: [smallest, largest]}",
                               {{is_mapping, uniform.rule()}, {is_scalar, one_radius}}),
             required, "one radius, or evenly between two")
      .key("inertia", &Fill::shape_factor, inertia_rule(), optional,
           "solid, shell, disk, ring or the factor q in I = q m R²")
      .key("area", &Fill::area, numbers(kLength, kAnyNumber, {4}), optional,
           "[x0, y0, x1, y1] of the centres; z in place of y in a container")
      .whole("volume", volume_rule(), optional,
             "in place of area: [x0, y0, z0, x1, y1, z1] of the centres")
      .exactly_one_of({"area", "volume"})
      .key("arrange", &Fill::arrange,
           choice<Fill::Arrange>(
               {{"random", Fill::Arrange::random}, {"lattice", Fill::Arrange::lattice}}),
           optional, "random places, or a triangular lattice for dense packings")
      .key("speed", &Fill::speed, number(kVelocity, kNotNegative), optional,
           "of each, in a random direction")
      .key("spin", &Fill::spin,
           choice<SpinKind>({{"none", SpinKind::none}, {"rolling", SpinKind::rolling}}), optional,
           "of each")
      .key("seed", &Fill::seed, integer(0, kLargestSeed), optional, "of the random numbers");
  return placed(fill.rule());
}

}  // namespace

Rule<std::vector<std::variant<WrittenBody, Fill>>> bodies_rule() {
  using Entry = std::variant<WrittenBody, Fill>;
  Record<Fill> fill;
  fill.whole("fill", one_fill_rule(), required, "many bodies in an area");
  return list(one_form_of<Entry>(
                  "must be a mapping",
                  {{[](const YamlNode& node) { return is_mapping(node) && node.find("fill"); },
                    as_alternative<Entry>(fill.rule())},
                   {is_mapping, as_alternative<Entry>(body_rule())}}),
              1);
}

Rule<std::vector<Fill>> fill_rule() {
  const Rule<Fill> fill = one_fill_rule();
  const Rule<std::vector<Fill>> alone = {
      [fill](const YamlNode& node, Reading& reading, std::vector<Fill>& target) {
        return fill.read(node, reading, target.emplace_back());
      },
      fill.schema};
  return one_form_of<std::vector<Fill>>(
      "must be a mapping or a list of them",
      {{[](const YamlNode& node) { return is_list(node); }, list(fill, 1)}, {is_mapping, alone}});
}

}  // namespace slipcheck
