#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace slipcheck {

/// What is read is no state of this program.
class BadState : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The state of a calculation as bytes, for the same program on the same kind of machine: numbers
/// as they lie in memory. Writing and reading are one list of members, so that neither can forget
/// one:
///
///   void exchange(StateArchive& archive) { archive(n_, positions_); }
class StateArchive {
 public:
  /// Writes.
  StateArchive() = default;
  /// Reads these bytes, which must outlive it.
  explicit StateArchive(std::string_view bytes) : left_(bytes), reads_(true) {}

  bool reads() const { return reads_; }
  /// What was written.
  std::string take() { return std::move(bytes_); }
  /// Nothing is left to be read. Throws BadState.
  void finish() const {
    if (!left_.empty()) throw BadState("has more in it than a state");
  }

  /// One after the other: what has an exchange(), strings, vectors, and what consists of numbers
  /// alone. Pointers among them are the caller's to set again.
  template <class... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

 private:
  template <class T>
  void one(T& value) {
    if constexpr (requires { value.exchange(*this); }) {
      value.exchange(*this);
    } else {
      static_assert(std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>);
      raw(&value, sizeof(T));
    }
  }
  void one(std::string& text) {
    text.resize(size_of(text.size(), 1));
    raw(text.data(), text.size());
  }
  template <class T, class Allocator>
  void one(std::vector<T, Allocator>& values) {
    constexpr bool kRaw = std::is_trivially_destructible_v<T> && !requires(T & each) {
      each.exchange(*this);
    };
    values.resize(size_of(values.size(), kRaw ? sizeof(T) : 1));
    if constexpr (kRaw)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (T& each : values) one(each);
  }

  /// How many there are of what takes `each` bytes at least.
  std::size_t size_of(std::size_t count, std::size_t each) {
    raw(&count, sizeof count);
    if (reads_ && count > left_.size() / each) throw BadState("ends too early");
    return count;
  }

  void raw(void* place, std::size_t bytes) {
    if (!reads_) {
      bytes_.append(static_cast<const char*>(place), bytes);
      return;
    }
    if (bytes > left_.size()) throw BadState("ends too early");
    if (bytes > 0) std::memcpy(place, left_.data(), bytes);
    left_.remove_prefix(bytes);
  }

  std::string bytes_;
  std::string_view left_;
  bool reads_ = false;
};

}  // namespace slipcheck
