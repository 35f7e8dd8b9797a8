// SPDX-License-Identifier: MIT
#include "sql.hpp"

#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "errors.hpp"

namespace shakedown {

namespace {
constexpr int longest_wait = 120000;  // ms, for other processes that write
}  // namespace

void SqlStatement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void Database::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }

Database::Database(const std::filesystem::path& file, Access access) : file_(file) {
  sqlite3* opened = nullptr;
  const int flags =
      access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
  handle_.reset(opened);
  if (code != SQLITE_OK) fail("cannot be opened");
  sqlite3_busy_timeout(opened, longest_wait);
}

void Database::execute(const std::string& sql) const {
  if (sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("cannot be used");
}

void Database::fail(std::string_view doing) const {
  throw FileError(file_.string() + ": " + std::string(doing) + " (" + sqlite3_errmsg(handle()) +
                  "); choose another file or make room there");
}

SqlStatement::SqlStatement(const Database& database, std::string_view sql) : database_(&database) {
  sqlite3_stmt* prepared = nullptr;
  const int code =
      sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &prepared, nullptr);
  statement_.reset(prepared);
  if (code != SQLITE_OK) database.fail("cannot be read");
}

SqlStatement& SqlStatement::bind(int parameter, std::string_view text) {
  sqlite3_bind_text(statement_.get(), parameter + 1, text.data(), static_cast<int>(text.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

SqlStatement& SqlStatement::bind(int parameter, double number) {
  std::isnan(number) ? sqlite3_bind_null(statement_.get(), parameter + 1)
                     : sqlite3_bind_double(statement_.get(), parameter + 1, number);
  return *this;
}

SqlStatement& SqlStatement::bind(int parameter, int number) {
  sqlite3_bind_int(statement_.get(), parameter + 1, number);
  return *this;
}

bool SqlStatement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    sqlite3_reset(statement_.get());
    database_->fail("cannot be read or written");
  }
  return code == SQLITE_ROW;
}

void SqlStatement::run() {
  while (step()) {
  }
  sqlite3_reset(statement_.get());
}

std::string SqlStatement::text(int column) const {
  const unsigned char* found = sqlite3_column_text(statement_.get(), column);
  return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

double SqlStatement::number(int column) const {
  const bool null = sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
  return null ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_.get(), column);
}

int SqlStatement::whole(int column) const { return sqlite3_column_int(statement_.get(), column); }

Transaction::Transaction(const Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace shakedown
