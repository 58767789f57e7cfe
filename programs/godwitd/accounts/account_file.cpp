#include "programs/godwitd/accounts/account_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/http/secret_file.hpp"
#include "io/link/descriptor.hpp"

namespace godwit::accounts {
namespace {

using checked = tl::expected<void, std::string>;
using nlohmann::json;

constexpr mode_t owner_only = S_IRUSR | S_IWUSR;

tl::unexpected<std::string> wrong(const std::string& file, const std::string& why) {
  return tl::make_unexpected("the accounts in " + file + ": " + why);
}

bool is_there(const std::string& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 || errno != ENOENT;
}

std::string problem_of(const account_list& all) {
  std::set<std::string> names;
  if (all.size() > max_accounts)
    return "there are more than " + std::to_string(max_accounts);
  for (const auto& each : all) {
    if (!is_account_name(each.name) || !names.insert(each.name).second)
      return "\"" + each.name.substr(0, max_account_name) + "\" is no name, or stands there twice";
    if (!is_sane(each.password))
      return "the password of " + each.name + " is not as godwitd operator writes it";
  }
  return {};
}

std::string text_of(const account_list& all) {
  json list = json::array();
  for (const auto& each : all)
    list.push_back(json::parse(io::to_json(each)));
  return json{{"version", 1}, {"accounts", std::move(list)}}.dump(2) + "\n";
}

checked store(const std::string& file, const account_list& all) {
  return io::http::store_secret_file(file, text_of(all), io::http::errc::token_file)
      .map_error([&](const io::http::error& why) { return "the accounts in " + why.message(); });
}

} // namespace

bool is_account_name(std::string_view name) {
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !name.empty() && name.size() <= max_account_name && is_plain(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return is_plain(c) || c == '-' || c == '.' || c == '_'; });
}

tl::expected<account_list, std::string> load(const std::string& file) {
  if (!is_there(file))
    return {};
  const auto text = io::http::load_secret_file(file, max_file_bytes, io::http::errc::token_file);
  if (!text)
    return tl::make_unexpected(text.error().message());
  const auto document = json::parse(text->revealed(), nullptr, false);
  if (!document.is_object() || document.value("version", 0) != 1)
    return wrong(file, "this is no file of accounts of version 1");
  account_list result;
  if (io::json_reading reading("accounts"); !io::read_value(reading, document.value("accounts", json()), result))
    return wrong(file, reading.message());
  if (auto problem = problem_of(result); !problem.empty())
    return wrong(file, problem);
  return result;
}

checked change(const std::string& file, const std::function<checked(account_list&)>& change) {
  const auto lock_file = file + ".lock";
  const io::link::descriptor lock(
      ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, owner_only)); // NOLINT(*-vararg)
  if (!lock.is_open() || ::flock(lock.number(), LOCK_EX) != 0)
    return wrong(file, lock_file + " can not be locked: " + std::strerror(errno));
  auto all = load(file);
  if (!all)
    return tl::make_unexpected(std::move(all.error()));
  if (auto changed = change(*all); !changed)
    return changed;
  if (auto problem = problem_of(*all); !problem.empty())
    return wrong(file, problem);
  return store(file, *all);
}

operator_bridge::account described(const stored_account& each) {
  return {each.name, each.role, each.password.salt, each.token_hash};
}

operator_bridge::accounts_read described(const account_list& all) {
  operator_bridge::accounts_read result;
  for (const auto& each : all)
    result.list.push_back(described(each));
  return result;
}

} // namespace godwit::accounts
