#include "report/files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw WriteFailure(
      fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(error)));
}

/// A name in the same directory that no other thread uses, nor another process that sees this one;
/// in a container the next one may have the same number. It is short, since the target's own name
/// may already be as long as a name can be.
fs::path temporary_name(const fs::path& directory) {
  static std::atomic<unsigned> count = 0;
  return directory / fmt::format(".slipcheck-{}-{}.tmp", ::getpid(), count++);
}

/// An open file that is closed, and removed where it has a name, unless it was kept.
class OpenFile {
 public:
  /// Throws WriteFailure about `target`, the file that the user knows.
  OpenFile(const fs::path& path, const fs::path& target)
      : target_(target), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail(target_, errno);
  }
  /// A new file beside the target, under temporary_name().
  static OpenFile beside(const fs::path& directory, const fs::path& target) {
    while (true) {
      OpenFile file(target);
      file.remove_later_ = temporary_name(directory);
      file.descriptor_ =
          ::open(file.remove_later_.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
      if (file.descriptor_ >= 0) return file;
      const int error = errno;
      file.remove_later_.clear();  // it is not ours
      if (error != EEXIST) fail(target, error);
    }
  }
  OpenFile(OpenFile&& other) noexcept
      : target_(std::move(other.target_)),
        remove_later_(std::exchange(other.remove_later_, {})),
        descriptor_(std::exchange(other.descriptor_, -1)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!remove_later_.empty()) ::unlink(remove_later_.c_str());
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const fs::path& temporary() const { return remove_later_; }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// Gives the new file the permissions of the one that it replaces.
  void set_mode(mode_t mode) {
    if (::fchmod(descriptor_, mode & 07777) != 0) fail(target_, errno);
  }

  /// Errors of a full disk or a lost server may show only now.
  void close(bool synchronise) {
    if (synchronise && ::fsync(descriptor_) != 0) fail(target_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(target_, errno);
  }

  void keep() { remove_later_.clear(); }

 private:
  explicit OpenFile(const fs::path& target) : target_(target) {}

  fs::path target_;
  fs::path remove_later_;
  int descriptor_ = -1;
};

/// After a power cut the directory must know the new name; not every file system can promise that.
void synchronise_directory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view text) {
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (exists && !S_ISREG(old.st_mode)) {
    OpenFile file(path, path);
    file.write(text);
    file.close(false);
    return;
  }

  // A symbolic link stays one: what it points at is replaced.
  std::error_code error;
  const fs::path target = exists ? fs::canonical(path, error) : path;
  if (error) fail(path, error.value());
  const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");

  OpenFile file = OpenFile::beside(directory, path);
  file.write(text);
  if (exists) file.set_mode(old.st_mode);
  file.close(true);
  if (::rename(file.temporary().c_str(), target.c_str()) != 0) fail(path, errno);
  file.keep();
  synchronise_directory(directory);
}

std::string why_not_writable(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!error && !fs::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  if (error) return error.message();
  if (!fs::is_directory(there, error)) return std::generic_category().message(ENOTDIR);
  fs::path trial = temporary_name(there);
  while (::mkdir(trial.c_str(), 0777) != 0) {
    if (errno != EEXIST) return std::generic_category().message(errno);
    trial = temporary_name(there);
  }
  ::rmdir(trial.c_str());
  return {};
}

}  // namespace slipcheck
