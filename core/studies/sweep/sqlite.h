#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace slipcheck {

/// What SQLite says of a data base: "database or disk is full".
class SqliteFailure : public std::runtime_error {
 public:
  SqliteFailure(int code, const std::string& what) : std::runtime_error(what), code_(code) {}
  int code() const { return code_; }  ///< SQLITE_FULL, SQLITE_NOTADB, …, extended

 private:
  int code_;
};

/// A column's value.
using SqliteValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A name as SQL quotes it.
std::string quoted_name(std::string_view name);

/// A connection to a data base in a file; by one thread at a time. Everything throws
/// SqliteFailure.
class SqliteFile {
 public:
  enum class Access { read, write };  ///< write: of a file that is there, maybe empty

  SqliteFile(const std::filesystem::path& path, Access access);
  ~SqliteFile();
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;

  /// Statements without values and results.
  void execute(const std::string& sql);
  /// Another file, to read from under a name.
  void attach(const std::filesystem::path& path, const std::string& name);
  std::int64_t integer_of(const std::string& sql);  ///< of the first row and column
  sqlite3* get() const { return handle_; }

 private:
  sqlite3* handle_ = nullptr;
};

/// A statement, used again and again.
class SqliteStatement {
 public:
  SqliteStatement(SqliteFile& file, const std::string& sql);
  ~SqliteStatement();
  SqliteStatement(SqliteStatement&& other) noexcept;
  SqliteStatement& operator=(SqliteStatement&&) = delete;

  /// Values by their position from 1 on; NaN is stored as NULL.
  SqliteStatement& bind(int position, double value);
  SqliteStatement& bind(int position, std::int64_t value);
  SqliteStatement& bind(int position, std::string_view text);
  SqliteStatement& bind(int position, const SqliteValue& value);
  SqliteStatement& bind_numbers(int position, std::span<const double> numbers);
  SqliteStatement& bind_nothing(int position);

  bool step();  ///< whether there is a row
  void run();   ///< to the end, ready for the next values

  int columns() const;
  std::string column_name(int column) const;
  SqliteValue value(int column) const;  ///< of the present row, from 0
  std::string text(int column) const;
  double number(int column) const;  ///< NaN of NULL
  std::int64_t integer(int column) const;
  std::vector<double> numbers(int column) const;  ///< of bind_numbers()
  void reset();

 private:
  void check(int code) const;
  sqlite3* file_;
  sqlite3_stmt* statement_ = nullptr;
};

/// All that is executed while it lives is done at once by commit(), or not at all.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteFile& file);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;
  void commit();

 private:
  SqliteFile& file_;
  bool open_ = true;
};

}  // namespace slipcheck
