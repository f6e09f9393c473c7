#include <fmt/format.h>

#include "scenario/rules/overlap.h"
#include "scenes.h"

// Rules that span several keys.

namespace slipcheck {
namespace {

using namespace testing;

std::string with_body(const std::string& body) {
  return with(kHard, "run: ", "  - {material: steel, sphere: {radius: 0.1}, " + body + "}\nrun: ");
}

TEST(Check, Names) {
  expect_fault(with_body("name: a, position: [5, 5]"),
               "s.yaml:16:52: bodies[2].name: must be unique, but is also bodies[0], got a");
  expect_fault(with_body("name: wall, position: [5, 5]"),
               "s.yaml:16:52: bodies[2].name: must not be a reserved name, got wall");
  expect_fault(with_body("name: a-b, position: [5, 5]"),
               "s.yaml:16:52: bodies[2].name: must not read like the pair of a and b, got a-b");
  expect_fault(with_body("name: a.b, position: [5, 5]"),
               "s.yaml:16:52: bodies[2].name: must be a name of letters, digits and _, joined by "
               "-, up to 64, "
               "got a.b");
  EXPECT_EQ(messages(with_body("name: ball-3, position: [5, 5]")), kNoFaults);
  // a-c with b, and a with c-b.
  std::string text = with_body("name: a-c, position: [5, 5]");
  text = with(text, "run: ",
              "  - {name: c-b, material: steel, sphere: {radius: 0.1}, position: [7, 7]}\nrun: ");
  expect_fault(text,
               "s.yaml:16:52: bodies[2].name: must not make pairs that read alike, as with "
               "c-b, got a-c");
  const auto faults =
      messages(with(kHard, "density: 7850}", "density: 7850}\n  wall: {density: 1}"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0], "s.yaml:6:9: materials.wall: must not have a reserved name");
}

TEST(Check, Materials) {
  expect_fault(with(kHard, "name: b, material: steel", "name: b, material: glass"),
               "s.yaml:15:25: bodies[1].material: must be one of the materials, got glass");
  expect_fault(with(kHard, "between: [steel, substrate]", "between: [glass, substrate]"),
               "s.yaml:10:15: contacts[1].between[0]: must be one of the materials or the scene's "
               "surroundings, got glass");
  std::string text = with(kHard, "{density: 7850}", "{}");
  EXPECT_EQ(messages(text),
            (std::vector<std::string>{
                "s.yaml:14:5: bodies[0]: needs a mass, as its material steel has no density",
                "s.yaml:15:5: bodies[1]: needs a mass, as its material steel has no density"}));
}

TEST(Check, ContactsAreComplete) {
  std::string text =
      with(kHard, "steel: {density: 7850}", "steel: {density: 7850}\n  glass: {density: 2500}");
  EXPECT_EQ(messages(text), kNoFaults);  // no body is of glass
  text = with(text, "name: b, material: steel", "name: b, material: glass");
  EXPECT_EQ(messages(text),
            (std::vector<std::string>{
                "s.yaml:8:3: contacts: needs a contact between glass and substrate, which can meet",
                "s.yaml:8:3: contacts: needs a contact between glass and steel, which can meet"}));
  EXPECT_EQ(messages(with(kContainer, "width:", "height: 5 mm, width:")),
            (std::vector<std::string>{
                "s.yaml:7:3: contacts: needs a contact between steel and lid, which can meet"}));
}

TEST(Check, ContactsAreNotGivenTwice) {
  expect_fault(
      with(kHard, "substrate: {}", "  - {between: [substrate, steel], friction: 1}\nsubstrate: {}"),
      "s.yaml:12:15: contacts[2].between: must name a pair once, and substrate and steel "
      "have a contact above, got [substrate, steel]");
}

TEST(Check, ContactsNameTheSurroundings) {
  expect_fault(
      with(kHard, "substrate: {}",
           "  - {between: [steel, floor], normal: {model: hard, restitution: 1}}\n"
           "substrate: {}"),
      "s.yaml:12:23: contacts[2].between[1]: is not part of this scene's surroundings, got "
      "floor");
  expect_fault(
      with(kHard, "[steel, substrate]", "[substrate, substrate]"),
      "s.yaml:10:14: contacts[1].between: must name a material, got [substrate, substrate]");
}

TEST(Check, ModelsHaveWhatTheyNeed) {
  EXPECT_EQ(messages(with(
                with(kHard, "{model: hard, restitution: 0.9}", "hertz"),
                "    tangential: {model: hard, friction: 0.1, tangential_restitution: 0.5}\n", "")),
            (std::vector<std::string>{
                "s.yaml:5:10: materials.steel.young_modulus: is missing, but contacts[0].normal "
                "(hertz) needs it",
                "s.yaml:5:10: materials.steel.poisson_ratio: is missing, but contacts[0].normal "
                "(hertz) needs it"}));
  EXPECT_EQ(
      messages(with(kHard, "friction: 0.2", "drilling: {model: uncoupled, contact_radius: hertz}"))
          .size(),
      2u);
  EXPECT_EQ(messages(with(kHard, "{model: hard, restitution: 0.9}",
                          "{model: power, modulus: 1, viscosity: 1}")),
            kNoFaults);
  expect_fault(with(kHard, "{model: hard, friction: 0.1, tangential_restitution: 0.5}",
                    "{model: viscous, friction: 0.1, damping_rate: 0.5}"),
               "s.yaml:9:25: contacts[0].tangential.model: must be none or hard with the normal "
               "model hard, got viscous");
}

TEST(Check, NoMassOutsideOfABody) {
  // I = ∫ r² dm with r <= R everywhere: at most m R², of a ring.
  expect_fault(with(kHard, "sphere: {radius: 0.1}", "sphere: {radius: 0.1, inertia: 1.001}"),
               "s.yaml:14:63: bodies[0].sphere.inertia: must be > 0 and <= 1, got 1.001");
  EXPECT_TRUE(
      messages(with(kHard, "sphere: {radius: 0.1}", "sphere: {radius: 0.1, inertia: 1}")).empty());
}

TEST(Check, AContactIsNoLargerThanTheBody) {
  const auto with_radius = [](const std::string& radius) {
    return with(kHard, "friction: 0.2",
                "friction: 0.2\n    drilling: {model: coupled, contact_radius: " + radius + "}");
  };
  EXPECT_TRUE(messages(with_radius("0.1")).empty());
  expect_fault(with_radius("1e20"),
               "s.yaml:12:48: contacts[1].drilling.contact_radius: must be at most the radius of "
               "the smallest body of steel, 0.1 m, got 1e20");
  // The smallest counts, of a fill too.
  EXPECT_EQ(messages(with(with_radius("0.06"), "bodies:",
                          "fill: {prefix: g, count: 2, material: steel, radius: {uniform: [0.05, "
                          "0.1]}, area: [5, 5, 9, 9]}\nbodies:"))
                .size(),
            1u);
}

TEST(Check, OneWayToGiveTheDissipation) {
  const auto faults = [](const std::string& normal) {
    std::string text = with(kHard, "{model: hard, restitution: 0.9}", "{model: " + normal + "}");
    text = with(text, "    tangential: {model: hard, friction: 0.1, tangential_restitution: 0.5}\n",
                "");
    return messages(
        with(text, "{density: 7850}", "{density: 7850, young_modulus: 2e11, poisson_ratio: 0}"));
  };
  const auto one = [](const std::string& rule) {
    return std::vector<std::string>{"s.yaml:8:13: contacts[0].normal: needs " + rule};
  };
  EXPECT_EQ(faults("power, modulus: 1, viscosity: 1"), kNoFaults);
  EXPECT_EQ(faults("power, modulus: 1, restitution: 0.5, at_speed: 1"), kNoFaults);
  EXPECT_EQ(faults("power, modulus: 1"), one("exactly one of viscosity or restitution"));
  EXPECT_EQ(faults("power, modulus: 1, viscosity: 1, restitution: 0.5, at_speed: 1"),
            one("exactly one of viscosity or restitution"));
  EXPECT_EQ(faults("power, modulus: 1, restitution: 0.5"),
            one("the key at_speed with restitution"));
  EXPECT_EQ(faults("power, modulus: 1, viscosity: 1, at_speed: 1"),
            one("the key restitution with at_speed"));
  EXPECT_EQ(faults("viscoelastic, restitution: 0.5, at_speed: 1"), kNoFaults);
  EXPECT_EQ(faults("viscoelastic, dissipation_time: 1, restitution: 0.5, at_speed: 1"),
            one("exactly one of dissipation_time, viscosity or restitution"));
  EXPECT_EQ(faults("viscoelastic"),
            one("exactly one of dissipation_time, viscosity or restitution"));
  EXPECT_EQ(faults("viscoelastic, restitution: 0, at_speed: 1"),
            std::vector<std::string>{
                "s.yaml:8:48: contacts[0].normal.restitution: must be > 0 and <= 1, got 0"});
  EXPECT_EQ(
      faults("viscoelastic, restitution: 0.5, at_speed: 0"),
      std::vector<std::string>{"s.yaml:8:63: contacts[0].normal.at_speed: must be > 0 m/s, got 0"});
  EXPECT_EQ(faults("viscoelastic, viscosity: [1, 2]"), kNoFaults);  // ν = 0 is a material too
  // K's linear law may be over-critical.
  EXPECT_EQ(faults("linear, damping_rate: 1e9, stiffness: 1"), kNoFaults);
}

TEST(Check, DissipationTimeIsNotNegative) {
  expect_fault(with(kHard, "{density: 7850}", "{density: 7850, dissipation_time: -1}"),
               "s.yaml:5:44: materials.steel.dissipation_time: must be >= 0 s, got -1");
}

TEST(Check, Friction) {
  expect_fault(with(kHard, "friction: 0.2", "friction: {static: 0.1, kinetic: 0.2}"),
               "s.yaml:11:24: contacts[1].friction.static: must be at least the kinetic friction "
               "0.2, got 0.1");
  expect_fault(with(kHard, "friction: 0.2", "friction: 0.2\n    rolling: 0.3"),
               "s.yaml:12:14: contacts[1].rolling: must be at most the static friction 0.2, or the "
               "body would slide and not roll (K 17), got 0.3");
  expect_fault(
      with(kHard, "friction: 0.2", "friction: 0.2\n    rolling: [[1, 0.1], [1, 0.2]]"),
      "s.yaml:12:26: contacts[1].rolling[1][0]: must be more than the speed before it, got 1");
  expect_fault(with(kHard, "friction: 0.2",
                    "friction: 0.2\n    rolling: {coefficient: [[1, 0.1], [2, 0.3]]}"),
               "s.yaml:12:43: contacts[1].rolling.coefficient[1][1]: must be at most the static "
               "friction 0.2, or the body would slide and not roll (K 17), got 0.3");
}

TEST(Check, Overlap) {
  expect_fault(with(kHard, "position: [1, 0]", "position: [0.15, 0]"),
               "s.yaml:15:65: bodies[1].position: must not overlap a, but does by 0.05 m (only "
               "bodies with a soft contact may, by less than the smaller radius), got [0.15, 0]");
  EXPECT_EQ(messages(with(kHard, "position: [1, 0]", "position: [0.2, 0]")), kNoFaults);
  EXPECT_EQ(messages(with(with(kHard, "position: [0, 0]", "position: [0.1, 0]"), "position: [1, 0]",
                          "position: [0.3, 0]")),
            kNoFaults);  // 0.3 − 0.1 < 0.2 by round-off
  // Across the boundary of a periodic cell, also at its corner.
  const std::string periodic = with(kHard, "substrate: {}", "substrate: {periodic: [2, 2]}");
  EXPECT_EQ(messages(with(periodic, "[1, 0]", "[1.9, 0]")).size(), 1u);
  EXPECT_EQ(messages(with(periodic, "[1, 0]", "[-0.15, 0]")).size(), 1u);
  EXPECT_EQ(messages(with(periodic, "[1, 0]", "[1.9, 1.9]")).size(), 1u);
  EXPECT_EQ(
      messages(with(with(periodic, "[0, 0]", "[0.05, 1.95]"), "[1, 0]", "[1.95, 0.05]")).size(),
      1u);
  EXPECT_EQ(messages(with(periodic, "[1, 0]", "[1.8, 0]")), kNoFaults);
  expect_fault(
      with(kHard, "substrate: {}", "substrate: {periodic: [2, 0.19]}"),
      "s.yaml:12:27: substrate.periodic[1]: must be at least 4 times the largest diameter, "
      "0.8 m, got 0.19");
}

TEST(Check, SoftBodiesMayOverlapByLessThanTheSmallerRadius) {
  const auto at = [](const char* position) { return with(kExample, "[-0.3, 0]", position); };
  const std::string place = "s.yaml:29:65: bodies[1].position: must not overlap i, but does by ";
  const std::string rule =
      " (bodies with a soft contact may, by less than the smaller radius), got ";
  EXPECT_EQ(messages(at("[-0.05, 0]")), kNoFaults);
  EXPECT_EQ(messages(at("[0.0999, 0]")), kNoFaults);
  expect_fault(at("[0.101, 0]"), place + "0.201 cm" + rule + "[0.101, 0]");
  expect_fault(at("[0.3, 0]"), place + "0.4 cm" + rule + "[0.3, 0]");
  // The pair's contact counts, and what the reference takes it for.
  const std::string overlap = at("[-0.05, 0]");
  EXPECT_EQ(messages(with(overlap, "reference: auto", "reference: contact")), kNoFaults);
  expect_fault(with(overlap, "reference: auto", "reference: event"),
               place +
                   "0.05 cm (not with the reference event, which takes soft contacts as hard "
                   "ones), got [-0.05, 0]");
  // Nothing overlaps across a periodic cell.
  expect_fault(with(overlap, "# periodic", "periodic"), place + "0.05 cm, got [-0.05, 0]");
}

/// How many of two bodies with these radii and places are refused.
std::size_t overlaps_of(double radius_a, const Vector3& a, double radius_b, const Vector3& b,
                        const std::optional<Vector2>& periodic = {}, const OverlapRule& rule = {}) {
  std::vector<Body> bodies(2);
  bodies[0].sphere.radius = radius_a;
  bodies[1].sphere.radius = radius_b;
  bodies[0].initial.position = a;
  bodies[1].initial.position = b;
  Reading reading("s.yaml", UnitSystem::si);
  check_overlaps(bodies, {"bodies[0]", "bodies[1]"}, periodic, reading, rule);
  return reading.faults().size();
}

TEST(Check, OverlapsOfUnlikeRadii) {
  // Soft bodies may overlap by less than the smaller radius, here 0.1, whichever comes first.
  const OverlapRule soft = [](const Body&, const Body&) { return std::nullopt; };
  for (const auto& [one, other] : {std::pair{0.1, 0.5}, {0.5, 0.1}}) {
    EXPECT_EQ(overlaps_of(one, {0, 0, 0}, other, {0.501, 0, 0}, {}, soft), 0u);
    EXPECT_EQ(overlaps_of(one, {0, 0, 0}, other, {0.499, 0, 0}, {}, soft), 1u);
    EXPECT_EQ(overlaps_of(one, {0, 0, 0}, other, {0.599, 0, 0}), 1u);
    EXPECT_EQ(overlaps_of(one, {0, 0, 0}, other, {0.601, 0, 0}), 0u);
  }
}

TEST(Check, OverlapsOfUnlikeRadiiAcrossAPeriodicEdge) {
  // A small body reaches over no edge that it is 0.35 away from, and meets a large one beyond it.
  const Vector2 cell(4, 5);
  for (const bool small_first : {true, false})
    for (const int axis : {0, 1})
      for (const double gap : {-0.001, 0.001}) {
        Vector3 near(1, 1, 0), far(1, 1, 0);
        near[axis] = 0.35;
        far[axis] = cell[axis] - (0.6 - 0.35 + gap);
        const std::size_t count = small_first ? overlaps_of(0.1, near, 0.5, far, cell)
                                              : overlaps_of(0.5, far, 0.1, near, cell);
        EXPECT_EQ(count, gap < 0 ? 1u : 0u) << axis << gap;
        // The large one at the near end.
        near[axis] = 0.3;
        far[axis] = cell[axis] - (0.6 - 0.3 + gap);
        EXPECT_EQ(overlaps_of(0.5, near, 0.1, far, cell), gap < 0 ? 1u : 0u) << axis << gap;
      }
  // Across the corner, from either side.
  for (const double gap : {-0.001, 0.001}) {
    const double off = (0.6 + gap) / std::sqrt(2);
    EXPECT_EQ(overlaps_of(0.1, {0.2, 0.2, 0}, 0.5, {4 + 0.2 - off, 5 + 0.2 - off, 0}, cell),
              gap < 0 ? 1u : 0u);
    EXPECT_EQ(overlaps_of(0.1, {0.2, 4.8, 0}, 0.5, {4 + 0.2 - off, 4.8 + off - 5, 0}, cell),
              gap < 0 ? 1u : 0u);
  }
}

TEST(Check, OverlapsOfManyBodies) {
  std::vector<Body> bodies;
  std::vector<std::string> paths;
  for (int i = 0; i < 100'000; ++i) {
    Body& body = bodies.emplace_back();
    body.sphere.radius = 0.5;
    body.initial.position = Vector3(i % 317, i / 317, 0.5);
    paths.push_back(fmt::format("bodies[{}]", i));
  }
  Reading reading("s.yaml", UnitSystem::si);
  check_overlaps(bodies, paths, Vector2(317, 317), reading);
  EXPECT_TRUE(reading.faults().empty());
  bodies[50'000].initial.position.x() += 0.1;
  check_overlaps(bodies, paths, Vector2(317, 317), reading);
  EXPECT_EQ(reading.faults().size(), 1u);
}

TEST(Check, Places) {
  expect_fault(
      with(kHard, "[1, 0]", "[1, 0, 0.05]"),
      "s.yaml:15:65: bodies[1].position: must be at least the radius above z = 0, got [1, 0, "
      "0.05]");
  EXPECT_EQ(messages(with(kHard, "[1, 0]", "[1, 0, 5]")), kNoFaults);
  const std::string confined = with(kHard, "substrate: {}", "substrate: {confined: true}");
  EXPECT_EQ(messages(confined), kNoFaults);
  expect_fault(
      with(confined, "[1, 0]", "[1, 0, 5]"),
      "s.yaml:15:65: bodies[1].position: must rest on a confined substrate, got [1, 0, 5]");
  expect_fault(with(confined, "[-1, 0]", "[-1, 0, 1]"),
               "s.yaml:15:83: bodies[1].velocity: must be horizontal on a confined substrate, got "
               "[-1, 0, 1]");
}

TEST(Check, Container) {
  expect_fault(
      with(kContainer, "\"2 mm\", \"3 mm\"", "\"0.4 mm\", \"3 mm\""),
      "s.yaml:12:70: bodies[0].position: must be at least the radius away from both walls, "
      "got [\"0.4 mm\", \"3 mm\"]");
  expect_fault(with(kContainer, "\"2 mm\", \"3 mm\"", "\"2 mm\", \"0.4 mm\""),
               "s.yaml:12:70: bodies[0].position: must be at least the radius above the floor, got "
               "[\"2 mm\", \"0.4 mm\"]");
  expect_fault(with(kContainer, "\"2 mm\", \"3 mm\"", "1, 2, 3"),
               "s.yaml:12:70: bodies[0].position: must be [x, z] in a container, got [1, 2, 3]");
  expect_fault(
      with(kContainer, "spin: 2", "spin: rolling"),
      "s.yaml:12:94: bodies[0].spin: must be none or a number in a container, got rolling");
  expect_fault(with(kContainer, "spin: 2", "spin: [1, 2, 0]"),
               "s.yaml:12:94: bodies[0].spin: must be about y alone in a container, got [1, 2, 0]");
  expect_fault(with(kHard, "velocity: [-1, 0]", "spin: 2"),
               "s.yaml:15:79: bodies[1].spin: must be none, rolling or [ωx, ωy, ωz], got 2");
}

TEST(Check, Run) {
  expect_fault(with(kHard, "until: rolling", "until: 5, limit: 3"),
               "s.yaml:16:24: run.limit: must be at least the time in until, got 3");
  EXPECT_EQ(parse_scenario(with(kHard, "until: rolling", "until: 500 ms"), "s.yaml").run.time, 0.5);
  expect_fault(with(kHard, "until: rolling", "until: rolling, discard: 3"),
               "s.yaml:16:32: run.discard: is only for a container, got 3");
  expect_fault(
      with(kContainer, "periods: 2000", "until: rest"),
      "s.yaml:14:14: run.until: must be a time in a container, or periods in its place, got "
      "rest");
  expect_fault(with(kContainer, "discard: 500", "discard: 2000"),
               "s.yaml:14:31: run.discard: must be less than periods, got 2000");
  expect_fault(with(kHard, "substrate: {}",
                    "substrate: {motion: {kind: table, table: [[0, 0, 0], [0, 1, 1]]}}"),
               "s.yaml:12:55: substrate.motion.table[1][0]: must be later than the time before it, "
               "got 0");
}

}  // namespace
}  // namespace slipcheck
