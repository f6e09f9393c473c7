#pragma once

#include <cstddef>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace slipcheck {

/// Allocator for large arrays that are looked into at random: where the system has pages of 2 MiB
/// it is asked for these, so that finding an address takes no memory access of its own. Linux;
/// elsewhere, and for small arrays, as std::allocator.
template <class T>
class HugePages {
 public:
  using value_type = T;

  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}  // NOLINT(google-explicit-constructor): as allocators do

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T) - kPage) throw std::bad_array_new_length();
    if (!is_large(n)) return static_cast<T*>(::operator new(n * sizeof(T), kSmall));
    // Whole pages, so that the last one is huge too.
    const std::size_t bytes = (n * sizeof(T) + kPage - 1) / kPage * kPage;
    void* block = ::operator new(bytes, kLarge);
#ifdef __linux__
    // Only advice: where it is not taken, pages are small.
    madvise(block, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t n) {
    ::operator delete(block, is_large(n) ? kLarge : kSmall);
  }

  bool operator==(const HugePages&) const { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
  static constexpr std::align_val_t kSmall{alignof(T)}, kLarge{kPage};

  static bool is_large(std::size_t n) { return n * sizeof(T) >= 2 * kPage; }
};

}  // namespace slipcheck
