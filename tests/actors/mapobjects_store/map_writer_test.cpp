#include "actors/mapobjects_store/map_writer.hpp"

#include <future>

#include "actors/mapobjects_store/sightings.hpp"
#include "io/sqlite/fault_vfs.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_writer_test {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;
using namespace godwit::tests;
using namespace std::chrono_literals;

constexpr auto patience = 60s;

class map_writer_test : public ::testing::Test {
protected:
  ~map_writer_test() override {
    fault_vfs::instance().disarm();
    writer.reset();
  }

  void open(map_writer_options options = {}) {
    options.store.file.path = folder.file();
    auto opened = map_writer::open(options);
    ASSERT_TRUE(opened.has_value()) << opened.error().message();
    writer = std::move(*opened);
  }

  // The answer to any work, when it comes.
  template <class Work>
  auto ask(Work work) {
    using result = decltype(work(std::declval<map_tables&>()));
    auto answer = std::make_shared<std::promise<result>>();
    auto coming = answer->get_future();
    const auto posted = writer->post(std::move(work), [answer](const result& done) { answer->set_value(done); });
    EXPECT_TRUE(posted.has_value());
    return coming;
  }
  auto record_later(std::uint64_t id, double east_m) {
    return ask([=](map_tables& t) { return record(t, seen(id, place(east_m))); });
  }
  template <class Result>
  static Result get(std::future<Result> coming) {
    EXPECT_EQ(coming.wait_for(patience), std::future_status::ready);
    return coming.get();
  }

  map_result<void> add_page(load_page page) {
    auto answer = std::make_shared<std::promise<map_result<void>>>();
    auto coming = answer->get_future();
    EXPECT_TRUE(writer->add_page(std::move(page), [answer](const map_result<void>& done) { answer->set_value(done); }));
    return get(std::move(coming));
  }

  map_result<void> finish(const finish_load& end) {
    auto answer = std::make_shared<std::promise<map_result<void>>>();
    auto coming = answer->get_future();
    EXPECT_TRUE(writer->finish(end, [answer](const map_result<void>& done) { answer->set_value(done); }));
    return get(std::move(coming));
  }

  scratch_folder folder;
  std::unique_ptr<map_writer> writer;
};

TEST_F(map_writer_test, each_sees_what_was_decided_before_it_and_hears_when_it_is_durable) {
  open();
  auto first = record_later(1, 0);
  auto second = record_later(2, 20);
  auto third = record_later(3, 20);
  EXPECT_EQ(get(std::move(first))->what.kind, observation_kind::found);
  EXPECT_EQ(get(std::move(second))->what.kind, observation_kind::moved);
  EXPECT_EQ(get(std::move(third))->what.kind, observation_kind::existing);
  EXPECT_EQ(owed_in(folder.file()).at(0).pending, 3U);
}

TEST_F(map_writer_test, a_refused_one_hears_why_and_its_neighbours_do_not_notice) {
  open();
  auto good = record_later(1, 0);
  auto bad = ask([](map_tables& t) { return record(t, sighting{}); });
  auto other = record_later(2, 100);
  EXPECT_TRUE(get(std::move(good)));
  EXPECT_EQ(get(std::move(bad)).error().code, map_errc::refused);
  EXPECT_TRUE(get(std::move(other)));
}

TEST_F(map_writer_test, a_change_that_fails_half_way_is_taken_out_of_its_group) {
  open();
  auto good = record_later(1, 0);
  auto wrong = ask([](map_tables& t) -> map_result<void> {
    if (auto done = record(t, seen(2, place(100))); !done)
      return tl::unexpected(done.error());
    return t.q.run("INSERT INTO nowhere VALUES (1)");
  });
  auto other = record_later(3, 200);
  EXPECT_TRUE(get(std::move(good)));
  EXPECT_EQ(get(std::move(wrong)).error().code, map_errc::internal);
  EXPECT_TRUE(get(std::move(other)));
  EXPECT_EQ(map_reader::open(folder.file())->objects()->objects.size(), 2U);
}

TEST_F(map_writer_test, a_disk_that_refuses_delays_and_loses_nothing) {
  std::promise<void> failing;
  std::promise<void> working;
  map_writer_options options;
  options.store.file.vfs = (fault_vfs::instance(), fault_vfs::name);
  options.retry_max = 20ms;
  options.on_health_change = [&](const map_writer_status& now) { (now.failing ? failing : working).set_value(); };
  open(options);
  ASSERT_TRUE(get(record_later(1, 0)));
  fault_vfs::instance().arm({.kind = fault_kind::disk_full, .at = 1, .from_then_on = true});
  auto waiting = record_later(2, 20);
  ASSERT_EQ(failing.get_future().wait_for(patience), std::future_status::ready);
  EXPECT_TRUE(writer->status().failing);
  EXPECT_EQ(waiting.wait_for(0s), std::future_status::timeout);
  fault_vfs::instance().disarm();
  EXPECT_EQ(get(std::move(waiting))->what.kind, observation_kind::moved);
  ASSERT_EQ(working.get_future().wait_for(patience), std::future_status::ready);
  EXPECT_FALSE(writer->status().failing);
}

TEST_F(map_writer_test, a_change_that_refuses_half_way_is_left_out_once) {
  open();
  auto good = record_later(1, 0);
  auto late = ask([](map_tables& t) -> map_result<void> {
    if (auto done = record(t, seen(2, place(100))); !done)
      return tl::unexpected(done.error());
    return refused("too late");
  });
  EXPECT_TRUE(get(std::move(good)));
  EXPECT_EQ(get(std::move(late)).error().code, map_errc::refused);
  EXPECT_EQ(map_reader::open(folder.file())->objects()->objects.size(), 1U);
}

TEST_F(map_writer_test, a_job_goes_on_by_itself_when_the_disk_works_again) {
  std::promise<void> failing;
  map_writer_options options;
  options.store.file.vfs = (fault_vfs::instance(), fault_vfs::name);
  options.retry_max = 20ms;
  options.on_health_change = [&](const map_writer_status& now) {
    if (now.failing)
      failing.set_value();
  };
  open(options);
  const auto number = get(ask([](map_tables& t) { return begin(t, {mission_a}); })).value().number;
  fault_vfs::instance().arm({.kind = fault_kind::io_error, .at = 1, .from_then_on = true});
  auto answer = std::make_shared<std::promise<map_result<void>>>();
  ASSERT_TRUE(writer->add_page({.load = number, .objects = {object(1, place(0))}, .ignored = {}},
                               [answer](const map_result<void>& done) { answer->set_value(done); }));
  ASSERT_EQ(failing.get_future().wait_for(patience), std::future_status::ready);
  fault_vfs::instance().disarm();
  EXPECT_TRUE(get(answer->get_future()));
}

TEST_F(map_writer_test, what_is_beyond_the_bound_is_refused_at_once) {
  map_writer_options options;
  options.max_queued = 2;
  open(options);
  std::promise<void> go_on;
  auto blocked = ask([gate = go_on.get_future().share()](map_tables&) -> map_result<void> {
    gate.wait();
    return {};
  });
  auto second = record_later(1, 0);
  const auto third = writer->post([](map_tables& t) { return record(t, seen(2, place(0))); },
                                  [](const map_result<observed>&) { FAIL(); });
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, map_errc::full);
  go_on.set_value();
  EXPECT_TRUE(get(std::move(blocked)));
  EXPECT_TRUE(get(std::move(second)));
}

TEST_F(map_writer_test, closing_writes_what_waits_and_refuses_what_comes) {
  open();
  auto waiting = record_later(1, 0);
  writer->close();
  EXPECT_TRUE(get(std::move(waiting)));
  const auto late = writer->post([](map_tables&) -> map_result<void> { return {}; }, [](const map_result<void>&) {});
  EXPECT_EQ(late.error().code, map_errc::closed);
}

TEST_F(map_writer_test, a_load_goes_on_beside_sightings_and_replaces_the_map_at_once) {
  open();
  const auto number = get(ask([](map_tables& t) { return begin(t, {mission_a}); })).value().number;
  load_page page{.load = number, .objects = {}, .ignored = {}};
  for (std::uint64_t i = 0; i < 3000; ++i)
    page.objects.push_back(object(1000 + i, place(static_cast<double>(i), 1000)));
  auto beside = record_later(1, 0);
  ASSERT_TRUE(add_page(page));
  EXPECT_TRUE(get(std::move(beside)));
  EXPECT_EQ(map_reader::open(folder.file())->objects()->objects.size(), 1U);
  const finish_load end{.load = number, .objects = 3000, .ignored = 0, .at_ns = 1};
  ASSERT_TRUE(finish(end));
  auto reader = map_reader::open(folder.file());
  EXPECT_EQ(reader->map()->last_object - reader->map()->first_object + 1, 3000);
  EXPECT_EQ(reader->objects({.among_loaded = true})->objects.size(), map_reader::max_objects);
}

TEST_F(map_writer_test, a_review_counts_all_that_was_posted_before_it) {
  open();
  auto first = record_later(1, 0);
  auto old = ask([](map_tables& t) { return record(t, seen(2, place(100), -5)); });
  auto answer = std::make_shared<std::promise<map_result<pass_reviewed>>>();
  const pass_end pass{.id = uuid(60),
                      .mission_id = mission_a,
                      .started_ns = 0,
                      .ended_ns = 9,
                      .class_groups = {"vehicle"},
                      .circles = {{place(0), 500}},
                      .polygons = {},
                      .confidence = 1};
  ASSERT_TRUE(writer->review(pass, [answer](const map_result<pass_reviewed>& done) { answer->set_value(done); }));
  const auto done = get(answer->get_future());
  ASSERT_TRUE(done);
  EXPECT_EQ(done->in_view, 2U);
  EXPECT_EQ(done->removed_candidates, 1U);
}

} // namespace map_writer_test
} // namespace godwit::mapobjects_store
