// Reads the map beside its writer: what is shown, page by page, and how far it can be relied on.
//
// Each call sees one committed state, whole. Thread: one at a time; open as many readers as you like. Blocks on the
// disk.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/mapobjects_store/map_row.hpp"
#include "io/sqlite/database.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

// Where a page begins: after this object.
struct object_place {
  bool among_loaded = false; // what was seen here comes first
  std::int64_t number = 0;
};

struct object_page {
  std::int64_t generation = 0; // another one than on the page before: the map was replaced, begin anew
  std::vector<map_object> objects;
  std::optional<object_place> next; // nothing: this was the last page
};

class map_reader {
public:
  static constexpr std::size_t max_objects = 1000;

  [[nodiscard]] static map_result<map_reader> open(const std::string& path);

  [[nodiscard]] map_result<map_row> map();
  [[nodiscard]] map_result<object_page> objects(const object_place& after = {});

private:
  explicit map_reader(io::sqlite::database db);

  std::unique_ptr<io::sqlite::database> db_; // a place of its own, which q_ points to
  std::unique_ptr<sql> q_;
};

} // namespace godwit::mapobjects_store
