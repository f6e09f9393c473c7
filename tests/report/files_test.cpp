#include "report/files/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "../support/as_nobody.h"
#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "../support/text_of.h"

namespace slipcheck::testing {
namespace {

namespace fs = std::filesystem;

class WriteFile : public test::InFolder {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string failure(const fs::path& path) {
    return test::refusal_of<WriteFailure>([&] { write_file_atomically(path, "new"); });
  }
};

TEST_F(WriteFile, WritesEveryByteAndNothingElse) {
  const std::string text = std::string("a\0b\r\n", 5) + std::string(300'000, 'x');
  write_file_atomically(folder_ / "result.json", text);
  EXPECT_EQ(test::text_of(folder_ / "result.json"), text);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, ReplacesAFileAndKeepsItsPermissions) {
  const fs::path path = folder_ / "result.json";
  write_file_atomically(path, "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(path, "new");
  EXPECT_EQ(test::text_of(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, FollowsTheUmask) {
  const mode_t old = ::umask(027);
  write_file_atomically(folder_ / "result.json", "");
  ::umask(old);
  struct stat status {};
  ASSERT_EQ(::stat((folder_ / "result.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST_F(WriteFile, NamesAFolderThatIsNotThere) {
  const fs::path path = folder_ / "absent" / "result.json";
  EXPECT_EQ(failure(path), "cannot write " + path.string() + ": No such file or directory");
}

TEST_F(WriteFile, DoesNotWriteOverAFolder) {
  EXPECT_EQ(failure(folder_), "cannot write " + folder_.string() + ": Is a directory");
}

TEST_F(WriteFile, LeavesTheOldFileInAReadOnlyFolder) {
  const AsNobody nobody(folder_);
  if (nobody.is_still_root()) GTEST_SKIP() << "root may write everywhere, and cannot be left";
  const fs::path path = folder_ / "result.json";
  write_file_atomically(path, "old");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(failure(path), "cannot write " + path.string() + ": Permission denied");
  EXPECT_EQ(test::text_of(path), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, LeavesTheOldFileWhenWritingBreaksOff) {
  const fs::path path = folder_ / "result.json";
  write_file_atomically(path, "old");
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{1, limit.rlim_max};  // the second byte of "new" is too many
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = failure(path);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, "cannot write " + path.string() + ": File too large");
  EXPECT_EQ(test::text_of(path), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, LeavesTheOldFileAndNoOtherWhenTheNameIsTooLong) {
  const fs::path path = folder_ / std::string(300, 'n');
  EXPECT_EQ(failure(path), "cannot write " + path.string() + ": File name too long");
  EXPECT_EQ(files(), 0u);
}

TEST_F(WriteFile, PassesOverWhatAnEarlierProcessOfThisNumberLeft) {
  for (int k = 0; k < 1000; ++k)
    std::ofstream(folder_ /
                  (".slipcheck-" + std::to_string(::getpid()) + "-" + std::to_string(k) + ".tmp"))
        << "left";
  write_file_atomically(folder_ / "result.json", "new");
  EXPECT_EQ(test::text_of(folder_ / "result.json"), "new");
  EXPECT_EQ(files(), 1001u);
}

TEST_F(WriteFile, TellsBeforehandWhatFolderTakesNothing) {
  EXPECT_EQ(why_not_writable(folder_), "");
  EXPECT_EQ(why_not_writable(folder_ / "not" / "yet"), "");
  write_file_atomically(folder_ / "file", "");
  EXPECT_EQ(why_not_writable(folder_ / "file" / "below"), "Not a directory");
  EXPECT_EQ(files(), 1u);
  fs::remove(folder_ / "file");
  const AsNobody nobody(folder_);
  if (nobody.is_still_root()) GTEST_SKIP() << "root may write everywhere, and cannot be left";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(why_not_writable(folder_ / "not" / "yet"), "Permission denied");
}

TEST_F(WriteFile, WritesToTheTargetOfALink) {
  write_file_atomically(folder_ / "target", "old");
  fs::create_symlink("target", folder_ / "link");
  write_file_atomically(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(test::text_of(folder_ / "target"), "new");
}

TEST_F(WriteFile, WritesToADeviceAsItIs) {
  write_file_atomically("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, ReportsAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(failure("/dev/full"), "cannot write /dev/full: No space left on device");
}

TEST_F(WriteFile, ShowsAReaderTheOldOrTheNewTextOnly) {
  const fs::path path = folder_ / "result.json";
  const std::string a(100'000, 'a'), b(100'000, 'b');
  write_file_atomically(path, a);
  std::thread writer([&] {
    for (int k = 0; k < 20; ++k) write_file_atomically(path, k % 2 ? a : b);
  });
  for (int k = 0; k < 100; ++k) {
    const std::string text = test::text_of(path);
    EXPECT_TRUE(text == a || text == b);
  }
  writer.join();
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace slipcheck::testing
