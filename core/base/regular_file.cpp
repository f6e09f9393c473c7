#include "base/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace slipcheck {
namespace {

[[noreturn]] void refuse_kind(const std::string& rule) { throw UnreadFile(rule, 0); }

[[noreturn]] void refuse_for(const char* rule, int error) {
  throw UnreadFile(fmt::format("{}: {}", rule, std::generic_category().message(error)), error);
}

[[noreturn]] void refuse_size(const FileLimit& limit) {
  const std::string_view name = limit.name;
  refuse_kind(fmt::format("must have at most {} bytes{}{}", limit.bytes,
                          name.empty() ? "" : ", the limit of ", name));
}

class OpenedFile {
 public:
  // O_NONBLOCK: a fifo without a writer would otherwise never open.
  explicit OpenedFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0) refuse_for("must be a readable file", errno);
  }
  ~OpenedFile() { ::close(descriptor_); }
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

std::string read_regular_file(const std::filesystem::path& path, const FileLimit& limit) {
  const OpenedFile file(path);
  struct stat status = {};
  if (::fstat(file.get(), &status) != 0) refuse_for("must be readable", errno);
  if (S_ISDIR(status.st_mode)) refuse_kind("must be a file, but is a directory");
  if (!S_ISREG(status.st_mode)) refuse_kind("must be a regular file");
  if (static_cast<std::uintmax_t>(status.st_size) > limit.bytes) refuse_size(limit);

  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(file.get(), buffer.data(), buffer.size());
    if (count == 0) return bytes;
    if (count < 0) {
      if (errno == EINTR) continue;
      refuse_for("must be readable", errno);
    }
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
    if (bytes.size() > limit.bytes) refuse_size(limit);  // of /proc, where sizes are zero
  }
}

}  // namespace slipcheck
