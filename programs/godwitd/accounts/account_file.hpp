// The accounts of operators, in a file of JSON: names, roles, what scrypt makes of passwords, SHA-256 of the tokens of
// programs. It holds no secret in the open, and all the same nobody else may read or write it.
//
//   {"version": 1, "accounts": [{"name": "anna", "role": "operator", "password": {...}, "token_hash": ""}]}
//
// Read as the files of tokens are: a regular file of mode 0600 of the user under whom godwitd runs. Written whole
// beside it and renamed over it; who changes it holds a lock meanwhile. A file that is not there has no accounts.
// Errors: sentences that name the file and the remedy. Thread: any; blocks on the disk. Source: open(2), flock(2).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"
#include "messages/operator_bridge/session.hpp"
#include "programs/godwitd/accounts/password.hpp"

namespace godwit::accounts {

inline constexpr std::size_t max_accounts = 100;
inline constexpr std::size_t max_file_bytes = 64 * 1024;
inline constexpr std::size_t max_account_name = 32;

struct stored_account {
  std::string name;
  operators::role role = operators::role::viewer;
  password_hash password;
  std::string token_hash; // of a program; empty: none
  GODWIT_FIELDS(stored_account, "accounts.account", name, role, password, token_hash);
};

using account_list = std::vector<stored_account>;

// 1 to 32 small letters, digits and -._, the first one a letter or digit.
[[nodiscard]] bool is_account_name(std::string_view name);

[[nodiscard]] tl::expected<account_list, std::string> load(const std::string& file);

// CHANGE says why it does not want to, or changes the list, which is written then.
[[nodiscard]] tl::expected<void, std::string>
change(const std::string& file, const std::function<tl::expected<void, std::string>(account_list&)>& change);

// As operator_bridge knows it.
[[nodiscard]] operator_bridge::account described(const stored_account& each);
[[nodiscard]] operator_bridge::accounts_read described(const account_list& all);

} // namespace godwit::accounts
