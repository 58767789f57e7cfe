// mapobjects_store with its thread and its file: real time, with wide margins.
#include "actors/mapobjects_store/map_port.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <future>
#include <memory>

#include "actors/mapobjects_store/actor.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/process.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_port_test {

using namespace godwit::tests;
using namespace std::chrono_literals;

constexpr auto patience = 60s; // for a machine under load

struct start_looking {
  static constexpr auto fields = io::table("test.start_looking");
};
using recogniser_handle = runtime::mailbox<runtime::tells<start_looking>>;

// Says that it has seen something when it is told to, and keeps what it hears.
class recogniser final : public runtime::actor_base<recogniser_handle> {
public:
  recogniser(runtime::spawn_context context, sighting_handle map, std::shared_ptr<std::promise<sighting_answer>> heard)
      : actor_base(std::move(context)), map_(std::move(map)), heard_(std::move(heard)) {}

protected:
  behavior_type handlers() override {
    return {on<start_looking>([this](const start_looking&) {
      ask(
          map_, patience, seen(10, place(0)), [this](const sighting_answer& answer) { heard_->set_value(answer); },
          [this](const runtime::ask_error& why) {
            heard_->set_value({std::nullopt, map_failure::broken, why.what});
          });
    })};
  }

private:
  sighting_handle map_;
  std::shared_ptr<std::promise<sighting_answer>> heard_;
};

class map_port_test : public ::testing::Test {
protected:
  map_port_test() {
    runtime::process_options options;
    options.journal.path = journal_folder_.file();
    std::filesystem::create_directories(std::filesystem::path(options.journal.path).parent_path());
    host_ = std::move(*runtime::process::open(options));
    store_ = host_->actors().add<actor>({.name = "mapobjects_store"}, {}, port);
    recogniser_ = host_->actors().add<recogniser>({.name = "recogniser"}, {}, sighting_handle(store_), heard_);
    host_->actors().start();
  }
  ~map_port_test() override {
    port->close();
    static_cast<void>(host_->finish(0));
  }

  map_result<void> open() {
    map_writer_options options;
    options.store.file.path = folder.file();
    return port->open(options, host_->actors().make_gateway("map_writer"), store_);
  }
  sighting_answer see() {
    auto way_in = host_->actors().make_gateway("test");
    way_in.tell(recogniser_, start_looking{});
    auto coming = heard_->get_future();
    EXPECT_EQ(coming.wait_for(patience), std::future_status::ready);
    return coming.get();
  }

  scratch_folder folder;
  std::shared_ptr<map_port> port = std::make_shared<map_port>();

private:
  scratch_folder journal_folder_;
  std::unique_ptr<runtime::process> host_;
  own_handle store_;
  recogniser_handle recogniser_;
  std::shared_ptr<std::promise<sighting_answer>> heard_ = std::make_shared<std::promise<sighting_answer>>();
};

TEST_F(map_port_test, an_answer_comes_back_from_the_writers_thread) {
  ASSERT_TRUE(open());
  const auto answer = see();
  ASSERT_TRUE(answer.seen) << answer.error;
  EXPECT_EQ(answer.seen->what.id, uuid(10));
  EXPECT_EQ(owed_in(folder.file()).at(0).pending, 1U);
}

TEST_F(map_port_test, before_it_is_open_an_asker_is_told_to_come_later) { EXPECT_EQ(see().failure, map_failure::busy); }

TEST_F(map_port_test, a_file_that_is_no_map_is_told_to_whoever_opens_it_and_to_each_who_asks) {
  std::filesystem::create_directories(std::filesystem::path(folder.file()).parent_path());
  std::ofstream(folder.file()) << "this is a text, and it is long enough to be taken for a header.....";
  const auto opened = open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, map_errc::foreign);
  const auto answer = see();
  EXPECT_EQ(answer.failure, map_failure::broken);
  EXPECT_EQ(answer.error, opened.error().message());
}

TEST_F(map_port_test, a_closed_one_takes_nothing) {
  ASSERT_TRUE(open());
  port->close();
  EXPECT_EQ(see().failure, map_failure::broken);
}

} // namespace map_port_test
} // namespace godwit::mapobjects_store
