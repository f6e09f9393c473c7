#include "studies/sweep/sqlite.h"

#include <cctype>
#include <cstring>
#include <exception>
#include <limits>
#include <utility>

namespace slipcheck {
namespace {

constexpr int kPatience = 10'000;  ///< with a reader or a writer that is at work [ms]

[[noreturn]] void fail(sqlite3* handle, int code) {
  throw SqliteFailure(code, handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code));
}

}  // namespace

std::string quoted_name(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

SqliteFile::SqliteFile(const std::filesystem::path& path, Access access) {
  const int flags = access == Access::write ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY;
  // Absolute, so that no name is taken for the address that attach() gives.
  const int code = sqlite3_open_v2(std::filesystem::absolute(path).c_str(), &handle_,
                                   flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI, nullptr);
  if (code != SQLITE_OK) {
    const SqliteFailure failure(code, sqlite3_errstr(code));
    sqlite3_close_v2(handle_);
    throw failure;
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, kPatience);
}

SqliteFile::~SqliteFile() { sqlite3_close_v2(handle_); }

void SqliteFile::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(handle_, code);
}

void SqliteFile::attach(const std::filesystem::path& path, const std::string& name) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string address = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_';
    address +=
        is_plain ? std::string(1, c) : std::string{'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  SqliteStatement(*this, "ATTACH ? AS " + quoted_name(name))
      .bind(1, std::string_view(address + "?mode=ro"))
      .run();
}

std::int64_t SqliteFile::integer_of(const std::string& sql) {
  SqliteStatement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

SqliteStatement::SqliteStatement(SqliteFile& file, const std::string& sql) : file_(file.get()) {
  check(sqlite3_prepare_v2(file_, sql.c_str(), static_cast<int>(sql.size()), &statement_, nullptr));
}

SqliteStatement::~SqliteStatement() { sqlite3_finalize(statement_); }

SqliteStatement::SqliteStatement(SqliteStatement&& other) noexcept
    : file_(other.file_), statement_(std::exchange(other.statement_, nullptr)) {}

void SqliteStatement::check(int code) const {
  if (code != SQLITE_OK) fail(file_, code);
}

SqliteStatement& SqliteStatement::bind(int position, double value) {
  check(sqlite3_bind_double(statement_, position, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(int position, std::int64_t value) {
  check(sqlite3_bind_int64(statement_, position, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(int position, std::string_view text) {
  check(sqlite3_bind_text64(statement_, position, text.data() != nullptr ? text.data() : "",
                            text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

SqliteStatement& SqliteStatement::bind(int position, const SqliteValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return bind(position, *integer);
  if (const auto* number = std::get_if<double>(&value)) return bind(position, *number);
  if (const auto* text = std::get_if<std::string>(&value))
    return bind(position, std::string_view(*text));
  return bind_nothing(position);
}

SqliteStatement& SqliteStatement::bind_numbers(int position, std::span<const double> numbers) {
  check(sqlite3_bind_blob64(statement_, position, numbers.data(), numbers.size_bytes(),
                            SQLITE_TRANSIENT));
  return *this;
}

SqliteStatement& SqliteStatement::bind_nothing(int position) {
  check(sqlite3_bind_null(statement_, position));
  return *this;
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  const SqliteFailure failure(code, sqlite3_errmsg(file_));
  sqlite3_reset(statement_);
  throw failure;
}

void SqliteStatement::run() {
  while (step()) {
  }
  reset();
}

void SqliteStatement::reset() { sqlite3_reset(statement_); }

int SqliteStatement::columns() const { return sqlite3_column_count(statement_); }

std::string SqliteStatement::column_name(int column) const {
  return sqlite3_column_name(statement_, column);
}

SqliteValue SqliteStatement::value(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_INTEGER:
      return sqlite3_column_int64(statement_, column);
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement_, column);
    case SQLITE_TEXT:
      return text(column);
    default:
      return std::monostate{};
  }
}

std::string SqliteStatement::text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  return bytes != nullptr ? std::string(bytes, size) : std::string();
}

double SqliteStatement::number(int column) const {
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL)
    return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_, column);
}

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::vector<double> SqliteStatement::numbers(int column) const {
  const void* bytes = sqlite3_column_blob(statement_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  std::vector<double> numbers(size / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes, numbers.size() * sizeof(double));
  return numbers;
}

SqliteTransaction::SqliteTransaction(SqliteFile& file) : file_(file) {
  file_.execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (!open_) return;
  try {
    file_.execute("ROLLBACK");
  } catch (const std::exception&) {  // it was rolled back already
  }
}

void SqliteTransaction::commit() {
  file_.execute("COMMIT");
  open_ = false;
}

}  // namespace slipcheck
