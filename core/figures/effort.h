#pragma once

namespace slipcheck {

/// How much a figure may cost: the same curves and statements, with fewer points and larger errors
/// or with more and smaller ones.
enum class Effort { brief, full };

}  // namespace slipcheck
