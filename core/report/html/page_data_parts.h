#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/rows/report_content.h"

namespace slipcheck {

/// How much motion a page has room for.
struct MotionDetail {
  std::size_t frames = 64;  ///< of one run at most
  bool nearest = true;      ///< also an engine's phase that is nearest to the reference
};

/// The finest detail in which all motion of these scenes fits on a page of a few megabytes, or else
/// the coarsest.
MotionDetail motion_detail(const std::vector<SceneRecord>& scenes);

/// Motion of a scene's bodies in the reference and in the engines, with speeds, slip and energy;
/// null where none was recorded and for more than 50 bodies.
nlohmann::json motion_page_data(const SceneRecord& scene, const MotionDetail& detail);

}  // namespace slipcheck
