#pragma once

#include "scenario/rules/rules.h"
#include "scenario/written_scene.h"

namespace slipcheck {

// The table of all keys, in parts. Each says what a key means, whether it must be there, and what
// may stand there; the loader and the JSON Schema are both made from it.

Rule<WrittenScene> scene_rule();
Rule<UnitSystem> units_rule();

Rule<std::vector<WrittenContact>> contacts_rule();
Rule<Substrate> substrate_rule();
Rule<Container> container_rule();
Rule<std::vector<WrittenSurface>> surfaces_rule();
Rule<std::vector<std::variant<WrittenBody, Fill>>> bodies_rule();
Rule<std::vector<Fill>> fill_rule();
/// `cue` of a body.
Rule<Cue> cue_rule();
Rule<WrittenRun> run_rule();
Rule<Compare> compare_rule();
/// `tolerance` in `compare`, by what they judge.
Rule<std::map<std::string, Tolerance>> tolerances_rule();
/// `expect` of an engine in `compare`.
Rule<Expectation> expectation_rule();

}  // namespace slipcheck
