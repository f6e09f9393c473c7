#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace slipcheck::testing {

/// Root may read and write everything, which tests of permissions cannot use: for a while be
/// nobody, who owns the folder. Does nothing for other users.
class AsNobody {
 public:
  explicit AsNobody(const std::filesystem::path& folder) {
    if (::geteuid() != 0) return;
    constexpr uid_t kNobody = 65534;
    was_root_ = ::chown(folder.c_str(), kNobody, 0) == 0 && ::seteuid(kNobody) == 0;
  }
  ~AsNobody() {
    if (was_root_ && ::seteuid(0) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

  /// In a sandbox that does not let root become another.
  bool is_still_root() const { return ::geteuid() == 0; }

 private:
  bool was_root_ = false;
};

}  // namespace slipcheck::testing
