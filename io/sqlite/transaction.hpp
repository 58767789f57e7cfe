// A write transaction that rolls back unless it was committed.
//
// Thread: the one of its database.
#pragma once

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

class transaction {
public:
  // IMMEDIATE takes the write lock at once: a transaction that began can not meet SQLITE_BUSY half way.
  [[nodiscard]] static result<transaction> begin(database& db);

  transaction(transaction&& other) noexcept;
  transaction& operator=(transaction&&) = delete;
  ~transaction();

  // After an error nothing of the transaction is visible.
  [[nodiscard]] result<void> commit();
  void rollback();

private:
  explicit transaction(database& db) : db_(&db) {}

  database* db_; // null when it has ended
};

} // namespace godwit::io::sqlite
