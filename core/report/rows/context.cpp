#include "report/rows/context.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <fstream>
#include <thread>

#include "report/terminal/text.h"
#include "report/version.h"

namespace slipcheck {
namespace {

std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

std::string build_type() {
  std::string type = SLIPCHECK_BUILD_TYPE;
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (type.empty()) type = "unknown";
#if defined(SLIPCHECK_SANITIZE)
  type += " with sanitizers";
#endif
  return type;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "unknown";
  return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return printable(line.substr(colon + 2));
  }
  return "unknown";
}

}  // namespace

const Context& context() {
  static const Context result{
      kVersion,  kCommit,       build_type(), compiler_name(),
      utc_now(), system_name(), cpu_model(),  std::thread::hardware_concurrency()};
  return result;
}

bool is_debug_build() {
#if defined(NDEBUG) && !defined(SLIPCHECK_SANITIZE)
  return false;
#else
  return true;
#endif
}

std::string debug_build_warning() {
  if (!is_debug_build()) return {};
  return fmt::format(
      "THIS IS A DEBUG BUILD ({}): all times in it are far too long. Results are as "
      "valid as ever.",
      context().build);
}

}  // namespace slipcheck
