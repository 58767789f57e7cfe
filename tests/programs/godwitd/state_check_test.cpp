#include "programs/godwitd/state_check.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/scratch.hpp"

namespace state_check_test {

using namespace godwit::daemon;
using godwit::test::scratch;

TEST(state_check, what_is_not_there_yet_is_no_objection) {
  const scratch folder;
  EXPECT_FALSE(objection_to_journal(folder.file("godwit.db")));
  EXPECT_FALSE(objection_to_map(folder.file("godwit.map.db")));
}

TEST(state_check, a_foreign_file_is_named) {
  const scratch folder;
  const auto notes = folder.write("notes", "these are my notes");
  for (const auto& objection : {objection_to_journal(notes), objection_to_map(notes)}) {
    ASSERT_TRUE(objection);
    EXPECT_NE(objection->find(notes), std::string::npos) << *objection;
  }
}

} // namespace state_check_test
