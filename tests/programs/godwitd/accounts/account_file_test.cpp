// The file of accounts, and who judges passwords against it.
#include "programs/godwitd/accounts/account_file.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>

#include <sys/stat.h>

#include "programs/godwitd/accounts/account_keeper.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace account_file_test {

using namespace godwit;
using namespace godwit::accounts;
using namespace std::chrono_literals;

password_hash cheap(const std::string& password) {
  password_hash like;
  like.n = 2;
  like.r = 1;
  like.p = 1;
  return hash_password(password, like);
}

class account_files : public testing::Test {
protected:
  void add(const std::string& name, const std::string& password, operators::role role = operators::role::operator_) {
    const auto done = change(file, [&](account_list& all) -> tl::expected<void, std::string> {
      std::erase_if(all, [&](const auto& each) { return each.name == name; });
      all.push_back({name, role, cheap(password), {}});
      return {};
    });
    ASSERT_TRUE(done) << done.error();
  }

  test::scratch folder;
  std::string file = folder.file("operators");
};

TEST_F(account_files, what_was_written_is_read_and_nobody_else_may) {
  EXPECT_TRUE(load(file)->empty()) << "none is there";
  add("anna", "correct horse", operators::role::engineer);
  const auto all = load(file);
  ASSERT_TRUE(all) << all.error();
  ASSERT_EQ(all->size(), 1U);
  EXPECT_EQ(all->front().role, operators::role::engineer);
  struct stat found {};
  ASSERT_EQ(::stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  ::chmod(file.c_str(), 0644);
  EXPECT_FALSE(load(file));
}

TEST_F(account_files, what_makes_no_sense_is_refused_and_named) {
  const auto put = [&](const std::string& text) {
    std::ofstream(file) << text;
    ::chmod(file.c_str(), 0600);
    return load(file);
  };
  for (const auto* text : {"x", "[]", R"({"version": 2, "accounts": []})",
                           R"({"version": 1, "accounts": [{"name": "anna", "colour": 1}]})",
                           R"({"version": 1, "accounts": [{"name": "anna", "role": "king"}]})",
                           R"({"version": 1, "accounts": [{"name": "anna"}]})", R"({"version": 1, "accounts": {}})"}) {
    const auto read = put(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().find(file), std::string::npos) << read.error();
  }
  EXPECT_TRUE(put(R"({"version": 1, "accounts": []})"));
}

TEST_F(account_files, a_change_that_is_not_wanted_changes_nothing) {
  add("anna", "correct horse");
  const auto refused = change(file, [](account_list& all) -> tl::expected<void, std::string> {
    all.clear();
    return tl::make_unexpected(std::string("no"));
  });
  EXPECT_FALSE(refused);
  EXPECT_EQ(load(file)->size(), 1U);
  EXPECT_FALSE(change(file, [](account_list& all) -> tl::expected<void, std::string> {
    all.push_back(all.front());
    return {};
  })) << "a name that stands there twice";
}

TEST(account_name, is_short_and_plain) {
  for (const auto* name : {"anna", "a", "7", "anna.b-c_d", "abcdefghijklmnopqrstuvwxyz012345"})
    EXPECT_TRUE(is_account_name(name)) << name;
  for (const auto* name : {"", "Anna", "-a", ".a", "a b", "a\n", "ä", "abcdefghijklmnopqrstuvwxyz0123456"})
    EXPECT_FALSE(is_account_name(name)) << name;
}

io::http::secret_text secret(std::string_view text) {
  io::http::secret_text result(text.size());
  std::ranges::copy(text, result.data());
  return result;
}

struct keeper_world {
  explicit keeper_world(const std::string& file) {
    auto opened = account_keeper::open(file);
    keeper = *std::move(opened);
    keeper->start([this](const auto& all) { told.push_back(all); }, [](const std::string&) {});
  }
  std::optional<operator_bridge::account> ask(const std::string& name, const std::string& password,
                                              const std::string& from = "::1") {
    std::promise<std::optional<operator_bridge::account>> answer;
    const bool is_taken = keeper->check({name, secret(password), from}, [&](auto who) {
      answer.set_value(who ? std::optional(*std::move(who)) : std::nullopt);
    });
    return is_taken ? answer.get_future().get() : std::nullopt;
  }
  std::vector<operator_bridge::accounts_read> told; // by the keeper's thread, before it answers
  std::unique_ptr<account_keeper> keeper;
};

TEST_F(account_files, a_password_opens_its_own_account_alone) {
  add("anna", "correct horse");
  add("bob", "battery staple");
  keeper_world world(file);
  ASSERT_TRUE(world.ask("anna", "correct horse"));
  EXPECT_FALSE(world.ask("anna", "battery staple"));
  EXPECT_FALSE(world.ask("nobody", "correct horse", "10.0.0.2"));
}

TEST_F(account_files, a_change_of_the_file_counts_from_the_next_try_on) {
  add("anna", "correct horse");
  keeper_world world(file);
  ASSERT_TRUE(world.ask("anna", "correct horse"));
  add("anna", "another horse");
  EXPECT_FALSE(world.ask("anna", "correct horse"));
  EXPECT_TRUE(world.ask("anna", "another horse"));
  EXPECT_EQ(world.told.size(), 2U);
  EXPECT_NE(world.told[0].list[0].stamp, world.told[1].list[0].stamp);
}

TEST_F(account_files, tries_after_a_failure_wait_and_too_many_of_one_address_are_not_taken) {
  add("anna", "correct horse");
  keeper_world world(file);
  EXPECT_FALSE(world.ask("anna", "wrong horse"));
  const auto since = std::chrono::steady_clock::now();
  EXPECT_TRUE(world.ask("anna", "correct horse"));
  EXPECT_GE(std::chrono::steady_clock::now() - since, std::chrono::milliseconds(login_delay::first_ms) - 50ms);
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(world.ask("anna", "wrong horse", "10.0.0.9")) << i;
  std::size_t taken = 0;
  for (int i = 0; i < 20; ++i)
    taken += world.keeper->check({"anna", secret("wrong horse"), "10.0.0.9"}, [](const auto&) {}) ? 1 : 0;
  EXPECT_LE(taken, account_keeper::max_waiting_of_one + 1);
  EXPECT_TRUE(world.ask("anna", "correct horse", "10.0.0.3")) << "from elsewhere";
}

TEST_F(account_files, who_fills_the_queue_from_elsewhere_keeps_nobody_here_from_logging_in) {
  add("anna", "correct horse");
  keeper_world world(file);
  const auto try_from = [&](const std::string& from) {
    return world.keeper->check({"anna", secret("wrong horse"), from}, [](const auto&) {});
  };
  std::size_t taken = 0;
  for (int network = 1; network <= 100; ++network)
    taken += try_from("2001:db8:0:" + std::to_string(network) + "::1") ? 1 : 0;
  EXPECT_GE(taken, account_keeper::max_waiting - account_keeper::max_waiting_of_one);
  EXPECT_LT(taken, 100U);
  EXPECT_TRUE(world.ask("anna", "correct horse", "127.0.0.1"));
}

TEST_F(account_files, addresses_that_fill_the_queue_give_way_to_one_from_elsewhere) {
  add("anna", "correct horse");
  keeper_world world(file);
  std::atomic<int> gave_way = 0;
  const auto fill = [&] {
    for (int address = 1; address <= 9; ++address)
      for (int i = 0; i < 5; ++i)
        (void)world.keeper->check(
            {"nobody" + std::to_string(i), secret("wrong horse"), "10.0.1." + std::to_string(address)},
            [&](const auto& who) { gave_way += !who && who.error() == account_keeper::refusal::gave_way ? 1 : 0; });
  };
  for (int i = 0; i < 3; ++i) {
    fill();
    EXPECT_TRUE(world.ask("anna", "correct horse", "10.0.0." + std::to_string(i + 1))) << i;
  }
  EXPECT_GE(gave_way, 1);
}

TEST_F(account_files, an_ipv6_network_has_the_share_of_one_address) {
  add("anna", "correct horse");
  keeper_world world(file);
  std::size_t taken = 0;
  for (int host = 1; host <= 20; ++host)
    taken +=
        world.keeper->check({"anna", secret("wrong horse"), "2001:db8::" + std::to_string(host)}, [](const auto&) {})
            ? 1
            : 0;
  EXPECT_LE(taken, account_keeper::max_waiting_of_one + 1); // one may be judged meanwhile
}

} // namespace account_file_test
