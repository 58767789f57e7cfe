#include "io/sqlite/migration.hpp"

#include "io/sqlite/transaction.hpp"

namespace godwit::io::sqlite {

result<void> run_migrations(database& db, const std::vector<std::string>& steps, std::int64_t found,
                            const std::string& set_version) {
  auto change = transaction::begin(db);
  if (!change)
    return tl::unexpected(std::move(change.error()));
  for (auto i = static_cast<std::size_t>(found); i < steps.size(); ++i)
    if (auto done = db.exec(steps[i]); !done)
      return done;
  if (auto done = db.exec(set_version); !done)
    return done;
  return change->commit();
}

} // namespace godwit::io::sqlite
