// SPDX-License-Identifier: MIT
// SQLite with errors as exceptions and handles that close themselves.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace shakedown {

class Database;

/// A prepared statement. Parameters and columns count from 0.
class SqlStatement {
 public:
  SqlStatement(const Database& database, std::string_view sql);
  /// Give a parameter its value (a text is copied) and return the statement.
  SqlStatement& bind(int parameter, std::string_view text);
  SqlStatement& bind(int parameter, double number);  ///< NaN: NULL
  SqlStatement& bind(int parameter, int number);
  /// Goes on to the next row; true when there is one. Throws FileError.
  bool step();
  /// Executes a statement without rows and makes it ready for the next time.
  void run();
  std::string text(int column) const;
  double number(int column) const;  ///< NULL: NaN
  int whole(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  const Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// One connection. Not for sharing between threads without a lock of the caller's.
class Database {
 public:
  enum class Access { read, write };  ///< write: makes the file when it is missing
  /// Opens the file. Throws FileError.
  Database(const std::filesystem::path& file, Access access);

  /// Executes statements without results, separated by semicolons. Throws FileError.
  void execute(const std::string& sql) const;
  [[noreturn]] void fail(std::string_view doing) const;
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// Everything until commit() happens or nothing does. Writers wait for each other before they read what they
/// will change.
class Transaction {
 public:
  explicit Transaction(const Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  /// Makes everything since the beginning happen. Throws FileError.
  void commit();

 private:
  const Database& database_;
  bool open_ = true;
};

}  // namespace shakedown
