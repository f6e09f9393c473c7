// A library to be loaded before all others (LD_PRELOAD) that makes one call of the program fail:
//
//   SLIPCHECK_FAULT=allocate:1234    the 1234th allocation after main() has begun gives nothing
//   SLIPCHECK_FAULT=write:3+         the third write and all after it fail
//   SLIPCHECK_FAULT_COUNT=FILE       none fails, or that one; at the end FILE tells how many calls
//   of each
//                                    kind there were, and for allocations the first of each call
//                                    stack
//
// Kinds are the names in kNames. A write of `short` takes one byte of what it is given and says so,
// which is no failure. What the C library does inside of itself (a stream's flush, for example) is
// not seen; fwrite() and its like are.
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Kind {
  allocate,
  write_,
  short_,
  sync_,
  rename_,
  open_,
  close_,
  folder,
  print,
  thread,
  process
};
constexpr const char* kNames[] = {"allocate", "write",  "short", "sync",   "rename", "open",
                                  "close",    "folder", "print", "thread", "process"};
constexpr int kKinds = sizeof kNames / sizeof kNames[0];

std::atomic<bool> armed{false};
std::atomic<long> counts[kKinds];
int failing = -1;
long at = 0;
bool lasts = false;
const char* counted = nullptr;
thread_local bool inside = false;

// Call stacks of allocations, by hash, and the number of the first allocation of each.
constexpr std::size_t kStacks = 1 << 18;
std::atomic<std::uint64_t> stacks[kStacks];
std::atomic<long> firsts[kStacks];

void note_stack(long number) {
  inside = true;
  void* frames[24];
  const int depth = backtrace(frames, 24);
  inside = false;
  std::uint64_t hash = 1469598103934665603u;
  for (int k = 2; k < depth; ++k)
    hash = (hash ^ reinterpret_cast<std::uintptr_t>(frames[k])) * 1099511628211u;
  hash |= 1;  // 0: a free place
  for (std::size_t place = hash % kStacks, tries = 0; tries < kStacks; ++tries) {
    std::uint64_t there = 0;
    if (stacks[place].compare_exchange_strong(there, hash)) {
      firsts[place] = number;
      return;
    }
    if (there == hash) return;
    place = (place + 1) % kStacks;
  }
}

/// Whether this call is the one that fails.
bool fails(Kind kind) {
  if (!armed.load(std::memory_order_relaxed) || inside) return false;
  const long number = ++counts[kind];
  if (kind == allocate && counted) note_stack(number);
  return kind == failing && (lasts ? number >= at : number == at);
}

template <class Function>
Function* real(Function*, const char* name) {
  inside = true;
  void* found = dlsym(RTLD_NEXT, name);
  inside = false;
  Function* function = nullptr;
  std::memcpy(&function, &found, sizeof found);
  return function;
}
/// The C library's function of that name; looked up once, as a forked child must not wait for the
/// loader.
#define REAL(name)                                        \
  ([] {                                                   \
    static decltype(&name) function = real(&name, #name); \
    return function;                                      \
  }())

/// What the environment says, before main().
void read_environment() {
  counted = std::getenv("SLIPCHECK_FAULT_COUNT");
  if (counted) {
    void* frames[4];
    inside = true;
    backtrace(frames, 4);  // loads what it needs
    inside = false;
  }
  const char* text = std::getenv("SLIPCHECK_FAULT");
  const char* colon = text ? std::strchr(text, ':') : nullptr;
  if (!colon) return;
  for (int k = 0; k < kKinds; ++k)
    if (std::strlen(kNames[k]) == static_cast<std::size_t>(colon - text) &&
        std::strncmp(kNames[k], text, std::strlen(kNames[k])) == 0)
      failing = k;
  char* end = nullptr;
  at = std::strtol(colon + 1, &end, 10);
  lasts = *end == '+';
}

void tell_stack() {
  armed = false;
  void* frames[64];
  backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
}

/// So does who reads at an address that there is none of, or gives up.
void on_fault(int number) {
  tell_stack();
  signal(number, SIG_DFL);
  raise(number);
}

int (*program)(int, char**, char**) = nullptr;

int counting_main(int argc, char** argv, char** environment) {
  read_environment();
  for (const int number : {SIGSEGV, SIGABRT}) signal(number, on_fault);
  armed = true;
  const int code = program(argc, argv, environment);
  armed = false;
  if (counted) {
    std::FILE* file = std::fopen(counted, "w");
    if (!file) std::abort();
    for (int k = 0; k < kKinds; ++k) std::fprintf(file, "%s %ld\n", kNames[k], counts[k].load());
    for (std::size_t place = 0; place < kStacks; ++place)
      if (stacks[place] != 0) std::fprintf(file, "first %ld\n", firsts[place].load());
    std::fclose(file);
  }
  return code;
}

void* none() {
  errno = ENOMEM;
  return nullptr;
}

template <class Result>
Result failed(int error) {
  errno = error;
  return static_cast<Result>(-1);
}

/// How many of these bytes are written; -1: that fails.
ssize_t taken(std::size_t count) {
  if (fails(write_)) return failed<ssize_t>(ENOSPC);
  return fails(short_) && count > 1 ? 1 : static_cast<ssize_t>(count);
}

constexpr int kErrorSeen = 0x20;  // _IO_ERR_SEEN of glibc's streams

bool print_fails(std::FILE* file) {
  if (!fails(print)) return false;
  file->_flags |= kErrorSeen;
  errno = ENOSPC;
  return true;
}

}  // namespace

// NOLINTBEGIN: the C library's names and signatures.
extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack) {
  using Start =
      int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  program = main;
  void* found = dlsym(RTLD_NEXT, "__libc_start_main");
  Start* start = nullptr;
  std::memcpy(&start, &found, sizeof found);
  return start(counting_main, argc, argv, init, fini, rtld_fini, stack);
}

/// Who aborts says from where.
void abort() noexcept {
  tell_stack();
  REAL(abort)();
  __builtin_unreachable();
}

void* malloc(size_t size) { return fails(allocate) ? none() : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
  return fails(allocate) ? none() : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  return fails(allocate) ? none() : __libc_realloc(old, size);
}
void* memalign(size_t alignment, size_t size) {
  return fails(allocate) ? none() : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** given, size_t alignment, size_t size) {
  void* memory = memalign(alignment, size);
  if (!memory) return ENOMEM;
  *given = memory;
  return 0;
}

ssize_t write(int fd, const void* data, size_t count) {
  const ssize_t size = taken(count);
  return size < 0 ? size : REAL(write)(fd, data, static_cast<size_t>(size));
}
ssize_t pwrite(int fd, const void* data, size_t count, off_t place) {
  const ssize_t size = taken(count);
  return size < 0 ? size : REAL(pwrite)(fd, data, static_cast<size_t>(size), place);
}
ssize_t pwrite64(int fd, const void* data, size_t count, off64_t place) {
  const ssize_t size = taken(count);
  return size < 0 ? size : REAL(pwrite64)(fd, data, static_cast<size_t>(size), place);
}
ssize_t writev(int fd, const struct iovec* parts, int count) {
  return fails(write_) ? failed<ssize_t>(ENOSPC) : REAL(writev)(fd, parts, count);
}
ssize_t send(int fd, const void* data, size_t count, int flags) {
  const ssize_t size = taken(count);
  return size < 0 ? size : REAL(send)(fd, data, static_cast<size_t>(size), flags);
}
int ftruncate(int fd, off_t size) {
  return fails(write_) ? failed<int>(EIO) : REAL(ftruncate)(fd, size);
}
int ftruncate64(int fd, off64_t size) {
  return fails(write_) ? failed<int>(EIO) : REAL(ftruncate64)(fd, size);
}

int fsync(int fd) { return fails(sync_) ? failed<int>(EIO) : REAL(fsync)(fd); }
int fdatasync(int fd) { return fails(sync_) ? failed<int>(EIO) : REAL(fdatasync)(fd); }
int rename(const char* from, const char* to) noexcept {
  return fails(rename_) ? failed<int>(EIO) : REAL(rename)(from, to);
}
int mkdir(const char* path, mode_t mode) noexcept {
  return fails(folder) ? failed<int>(EACCES) : REAL(mkdir)(path, mode);
}
char* mkdtemp(char* name) noexcept {
  if (!fails(folder)) return REAL(mkdtemp)(name);
  errno = EACCES;
  return nullptr;
}

#define MODE_OF(flags)                   \
  mode_t mode = 0;                       \
  if ((flags) & (O_CREAT | O_TMPFILE)) { \
    va_list more;                        \
    va_start(more, flags);               \
    mode = va_arg(more, mode_t);         \
    va_end(more);                        \
  }
int open(const char* path, int flags, ...) {
  MODE_OF(flags)
  return fails(open_) ? failed<int>(EMFILE) : REAL(open)(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  MODE_OF(flags)
  return fails(open_) ? failed<int>(EMFILE) : REAL(open64)(path, flags, mode);
}
int openat(int at_folder, const char* path, int flags, ...) {
  MODE_OF(flags)
  return fails(open_) ? failed<int>(EMFILE) : REAL(openat)(at_folder, path, flags, mode);
}
FILE* fopen(const char* path, const char* how) {
  if (!fails(open_)) return REAL(fopen)(path, how);
  errno = EMFILE;
  return nullptr;
}
FILE* fopen64(const char* path, const char* how) {
  if (!fails(open_)) return REAL(fopen64)(path, how);
  errno = EMFILE;
  return nullptr;
}
int close(int fd) {
  const bool failure = fails(close_);
  const int done = REAL(close)(fd);  // as Linux: it is closed, whatever it says
  return failure ? failed<int>(EIO) : done;
}

size_t fwrite(const void* data, size_t size, size_t count, FILE* file) {
  return print_fails(file) ? 0 : REAL(fwrite)(data, size, count, file);
}
size_t fwrite_unlocked(const void* data, size_t size, size_t count, FILE* file) {
  return print_fails(file) ? 0 : REAL(fwrite_unlocked)(data, size, count, file);
}
int fputs(const char* text, FILE* file) {
  return print_fails(file) ? EOF : REAL(fputs)(text, file);
}
int fflush(FILE* file) { return file && print_fails(file) ? EOF : REAL(fflush)(file); }

int pthread_create(pthread_t* made, const pthread_attr_t* how, void* (*work)(void*),
                   void* argument) noexcept {
  return fails(thread) ? EAGAIN : REAL(pthread_create)(made, how, work, argument);
}
pid_t fork() noexcept { return fails(process) ? failed<pid_t>(EAGAIN) : REAL(fork)(); }
int posix_spawnp(pid_t* made, const char* file, const posix_spawn_file_actions_t* actions,
                 const posix_spawnattr_t* how, char* const words[], char* const variables[]) {
  return fails(process) ? EAGAIN : REAL(posix_spawnp)(made, file, actions, how, words, variables);
}
int pipe2(int ends[2], int flags) noexcept {
  return fails(process) ? failed<int>(EMFILE) : REAL(pipe2)(ends, flags);
}
int socketpair(int domain, int type, int protocol, int ends[2]) noexcept {
  return fails(process) ? failed<int>(EMFILE) : REAL(socketpair)(domain, type, protocol, ends);
}

}  // extern "C"
// NOLINTEND
