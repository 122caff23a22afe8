// A listed struct as a Python class: an attribute for each member of its list (core/members.h), by the list's name.
#pragma once

#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "arrays.h"
#include "meanings.h"
#include "ripstop/core/members.h"

namespace ripstop::python {

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;

/// A member in Python. Members larger than a number refer to their memory in `owner`.
template <class T>
py::object to_python(const T& value, py::handle owner) {
  if constexpr (is_optional<T>) {
    return value ? to_python(*value, owner) : py::none();
  } else if constexpr (std::is_same_v<T, Vec3>) {
    return view_of(&value.x, {3}, owner);
  } else if constexpr (is_array<T>) {
    return view_of(value.data(), {static_cast<py::ssize_t>(value.size())}, owner);
  } else if constexpr (Listed<T>) {
    return py::cast(&value, py::return_value_policy::reference_internal, owner);
  } else if constexpr (is_vector<T>) {
    using Item = typename T::value_type;
    if constexpr (std::is_arithmetic_v<Item> || std::is_same_v<Item, Vec3>) {
      return view_of(value, owner);
    } else {
      if constexpr (Listed<Item>)
        if (is_table_row<Item>()) return table_of(value, owner);
      py::list items;
      for (const Item& item : value) items.append(to_python(item, owner));
      return items;
    }
  } else {
    return py::cast(value);
  }
}

/// Its type in a stub. Listed structs are classes of the module by then.
template <class T>
std::string type_name() {
  if constexpr (is_optional<T>) {
    return "Optional[" + type_name<typename T::value_type>() + "]";
  } else if constexpr (std::is_same_v<T, Vec3> || is_array<T>) {
    return "numpy.ndarray";
  } else if constexpr (is_vector<T>) {
    using Item = typename T::value_type;
    if constexpr (std::is_arithmetic_v<Item> || std::is_same_v<Item, Vec3>) return "numpy.ndarray";
    if constexpr (Listed<Item>)
      if (is_table_row<Item>()) return "numpy.ndarray";
    return "list[" + type_name<Item>() + "]";
  } else if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_integral_v<T>) {
    return "int";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "float";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "str";
  } else {
    return py::type::of<T>().attr("__name__").template cast<std::string>();
  }
}

template <Listed T>
py::object member_at(const T& value, int index, py::handle owner) {
  py::object found;
  int i = 0;
  each_member(value, [&](const char*, const auto& member, auto&&...) {
    if (i++ == index) found = to_python(member, owner);
  });
  return found;
}

/// Name(first=..., second=...); arrays by their shape.
py::str text_of(py::handle object);
/// As plain dictionaries, lists and numbers: the content of result.json.
py::object plain_of(const std::string& json);

/// The members of get(holder) as attributes of `Class`, similar to a dataclass: their types are in
/// __annotations__ and __match_args__. More attributes may follow; repr shows those of the list.
template <class Holder, class Get>
void add_members(py::class_<Holder>& type, Get get) {
  using T = std::decay_t<decltype(get(std::declval<const Holder&>()))>;
  const auto class_name = py::str(type.attr("__name__")).template cast<std::string>();
  py::dict annotations;
  py::list names;
  int count = 0;
  T value;
  each_member(value, [&](const char* name, const auto& member, auto&&...) {
    const int index = count++;
    const std::string doc = meaning_of(class_name, name);
    type.def_property_readonly(name,
                               py::cpp_function(
                                   [get, index](py::object self) {
                                     return member_at(get(self.template cast<const Holder&>()), index, self);
                                   },
                                   py::is_method(type)),
                               doc.c_str());
    annotations[name] = type_name<std::decay_t<decltype(member)>>();
    names.append(name);
  });
  type.attr("__annotations__") = annotations;
  type.attr("__match_args__") = py::tuple(names);
  type.def("__repr__", [](py::object self) { return text_of(self); });
}

/// The struct itself as a class that Python cannot make.
template <Listed T>
py::class_<T> add_class(py::module_& module, const char* name, const char* doc) {
  py::class_<T> type(module, name, doc);
  add_members(type, [](const T& value) -> const T& { return value; });
  return type;
}

/// to_json() and asdict() of classes with a result.json.
template <class Holder, class Get>
void add_json(py::class_<Holder>& type, Get get) {
  type.def(
      "to_json", [get](const Holder& self) { return to_json(get(self)); },
      "Returns the text of result.json.");
  type.def(
      "asdict", [get](const Holder& self) -> py::dict { return plain_of(to_json(get(self))); },
      "Returns the content as plain dictionaries, lists, numbers and texts.");
}
template <Listed T>
py::class_<T> add_result(py::module_& module, const char* name, const char* doc) {
  py::class_<T> type = add_class<T>(module, name, doc);
  add_json(type, [](const T& value) -> const T& { return value; });
  return type;
}

}  // namespace ripstop::python
