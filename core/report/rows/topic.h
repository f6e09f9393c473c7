#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

/// Under what reports group a scene: what it is, as in "Slopes" or "Moving ground".
std::string topic_of(const Scenario& scenario);

/// All topics, in the order in which reports have them.
const std::vector<std::string>& known_topics();

/// Whether reports have one topic before another.
bool is_topic_before(const std::string& one, const std::string& other);

}  // namespace slipcheck
