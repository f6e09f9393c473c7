#pragma once

namespace slipcheck {

/// Cases of a variant, for std::visit.
template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Match(Cases...) -> Match<Cases...>;

}  // namespace slipcheck
