#include "io/sqlite/transaction.hpp"

#include <utility>

namespace godwit::io::sqlite {

result<transaction> transaction::begin(database& db) {
  auto begun = db.exec("BEGIN IMMEDIATE");
  if (!begun)
    return tl::unexpected(std::move(begun.error()));
  return transaction(db);
}

transaction::transaction(transaction&& other) noexcept : db_(std::exchange(other.db_, nullptr)) {}

transaction::~transaction() { rollback(); }

result<void> transaction::commit() {
  auto committed = db_->exec("COMMIT");
  if (!committed)
    rollback();
  db_ = nullptr;
  return committed;
}

void transaction::rollback() {
  // SQLite ends a transaction by itself on some errors; a second ROLLBACK would only be an error of its own.
  if (db_ != nullptr && db_->in_transaction())
    static_cast<void>(db_->exec("ROLLBACK"));
  db_ = nullptr;
}

} // namespace godwit::io::sqlite
