// A TOML file as a tree of values with their places. Only document.cpp uses the parser, toml++.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ripstop {

struct Place {
  int line = 0, column = 0;  // counted from 1; 0: unknown
};

struct Node {
  enum class Type { table, array, text, integer, number, boolean, date };
  Type type = Type::table;
  Place place;      // of the value
  std::string key;  // in a table: the member's key
  Place key_place;
  std::string text;
  long long integer = 0;
  double number = 0;  // also of an integer
  bool boolean = false;
  std::vector<Node> items;  // of an array; members of a table

  const Node* find(const std::string& wanted) const;
};

struct Document {
  std::string name;  // the file in messages
  Node root;
};

/// Throws InputError(usage) with the place of the first mistake in the syntax; double
/// keys are such a mistake.
Document parse_toml(const std::string& text, const std::string& name);
/// Contents of a text file of at most 1 MiB. Throws Error(io).
std::string read_text_file(const std::filesystem::path& file);

}  // namespace ripstop
