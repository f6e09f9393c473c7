#pragma once

#include <set>
#include <string>
#include <string_view>

namespace slipcheck {

/// A name made fit for a file and for an id on a page: small and capital letters, digits, '.', '_'
/// and '-', whatever else stands between them one '-'; never empty, never hidden. One that is in
/// `taken` gets a number; the result is added.
std::string file_stem(std::string_view name, std::set<std::string>& taken);

}  // namespace slipcheck
