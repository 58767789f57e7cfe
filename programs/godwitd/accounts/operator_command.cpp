#include "programs/godwitd/accounts/operator_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include <termios.h>
#include <unistd.h>

#include "programs/godwitd/accounts/account_file.hpp"
#include "programs/godwitd/accounts/password.hpp"
#include "programs/godwitd/console.hpp"

namespace godwit::accounts {

namespace {

using runtime::exit_code;
using changed = tl::expected<void, std::string>;

void print(const std::string& line) { (void)std::puts(line.c_str()); }

exit_code fail(exit_code code, const std::string& sentence) {
  daemon::say(sentence);
  return code;
}

stored_account* find(account_list& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &stored_account::name);
  return found == all.end() ? nullptr : &*found;
}

changed no_account(const std::string& name) {
  return tl::make_unexpected("there is no account " + name + "; godwitd operator list shows who there is");
}

changed there_is_one(const std::string& name) {
  return tl::make_unexpected("there is an account " + name + " already; godwitd operator passwd changes its password");
}

exit_code end_with(const changed& done, const std::string& sentence) {
  if (!done)
    return fail(exit_code::failed, done.error());
  print(sentence);
  return exit_code::ok;
}

// Before it asks for a password, so that nobody types one in vain.
changed look_first(const operator_arguments& asked, const std::string& file) {
  auto all = load(file);
  if (!all)
    return tl::make_unexpected(std::move(all.error()));
  const bool is_there = find(*all, asked.name) != nullptr;
  if (asked.act == operator_act::add)
    return is_there ? there_is_one(asked.name) : changed();
  return is_there ? changed() : no_account(asked.name);
}

exit_code set_password(const operator_arguments& asked, const std::string& file) {
  if (const auto first = look_first(asked, file); !first)
    return fail(exit_code::failed, first.error());
  const auto password = ask_new_password(asked.name);
  if (!password)
    return fail(exit_code::failed, password.error());
  const auto hash = hash_password(password->revealed());
  const auto done = change(file, [&](account_list& all) -> changed {
    auto* const account = find(all, asked.name);
    if (asked.act == operator_act::add) {
      if (account != nullptr)
        return there_is_one(asked.name);
      all.push_back({asked.name, asked.role, hash, {}});
      return {};
    }
    if (account == nullptr)
      return no_account(asked.name);
    account->password = hash;
    return {};
  });
  return end_with(done, asked.act == operator_act::add
                            ? asked.name + " is " + std::string(io::name_of(asked.role)) + " now"
                            : "the password of " + asked.name + " is changed; sessions with the old one end");
}

exit_code make_token(const operator_arguments& asked, const std::string& file) {
  const auto token = new_token();
  const auto done = change(file, [&](account_list& all) -> changed {
    auto* const account = find(all, asked.name);
    if (account == nullptr)
      return no_account(asked.name);
    account->token_hash = hash_of_token(token.revealed());
    return {};
  });
  return end_with(done, std::string(token.revealed()));
}

exit_code remove(const operator_arguments& asked, const std::string& file) {
  const auto done = change(file, [&](account_list& all) -> changed {
    return std::erase_if(all, [&](const auto& each) { return each.name == asked.name; }) == 0 ? no_account(asked.name)
                                                                                              : changed();
  });
  return end_with(done, asked.name + " is removed; sessions of " + asked.name + " end");
}

exit_code list(const std::string& file) {
  const auto all = load(file);
  if (!all)
    return fail(exit_code::failed, all.error());
  for (const auto& each : *all)
    print(each.name + "  " + std::string(io::name_of(each.role)) + (each.token_hash.empty() ? "" : "  with a token"));
  return exit_code::ok;
}

} // namespace

exit_code run_operator(const operator_arguments& asked, const std::string& file) {
  if (asked.act != operator_act::list && !is_account_name(asked.name))
    return fail(exit_code::usage, "a name has 1 to " + std::to_string(max_account_name) +
                                      " small letters, digits and -._, and begins with a letter or a digit");
  switch (asked.act) {
  case operator_act::add:
  case operator_act::passwd:
    return set_password(asked, file);
  case operator_act::token:
    return make_token(asked, file);
  case operator_act::remove:
    return remove(asked, file);
  case operator_act::list:
    break;
  }
  return list(file);
}

namespace {

using io::http::secret_text;
using asked = tl::expected<secret_text, std::string>;

// The terminal shows what is typed again, whatever happens.
class silence {
public:
  silence() {
    is_terminal_ = ::tcgetattr(STDIN_FILENO, &before_) == 0;
    auto quiet = before_;
    quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    if (is_terminal_)
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &quiet);
  }
  ~silence() {
    if (is_terminal_)
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  silence(const silence&) = delete;
  silence& operator=(const silence&) = delete;

private:
  termios before_{};
  bool is_terminal_ = false;
};

asked read_line() {
  secret_text result(max_password + 2);
  std::size_t size = 0;
  char each = 0;
  while (size < max_password + 2 && ::read(STDIN_FILENO, &each, 1) == 1 && each != '\n')
    result.data()[size++] = each;
  if (size > 0 && result.data()[size - 1] == '\r')
    --size;
  result.cut_to(size);
  if (size < min_password || size > max_password)
    return tl::make_unexpected("a password has " + std::to_string(min_password) + " to " +
                               std::to_string(max_password) + " bytes");
  return result;
}

asked ask(const std::string& question) {
  (void)std::fputs(question.c_str(), stderr);
  auto result = [] {
    const silence while_typing;
    return read_line();
  }();
  (void)std::fputs("\n", stderr);
  return result;
}

} // namespace

asked ask_new_password(const std::string& name) {
  if (::isatty(STDIN_FILENO) == 0)
    return read_line();
  auto first = ask("New password of " + name + ": ");
  if (!first)
    return first;
  const auto second = ask("Once more: ");
  if (!second || second->revealed() != first->revealed())
    return tl::make_unexpected(std::string("that was not the same twice; nothing was changed"));
  return first;
}

} // namespace godwit::accounts
