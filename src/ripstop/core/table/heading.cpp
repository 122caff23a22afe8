#include "ripstop/core/table/heading.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

using Q = Quantity;

struct QuantityName {
  Quantity quantity;
  const char* name;
  Dimension dimension;
};
constexpr std::array<QuantityName, 11> quantities{{{Q::force, "force", Dimension::force},
                                                   {Q::extension, "extension", Dimension::length},
                                                   {Q::strain, "strain", Dimension::fraction},
                                                   {Q::stress, "stress", Dimension::pressure},
                                                   {Q::time, "time", Dimension::time},
                                                   {Q::altitude, "altitude", Dimension::length},
                                                   {Q::speed, "speed", Dimension::speed},
                                                   {Q::acceleration, "acceleration", Dimension::acceleration},
                                                   {Q::pressure, "pressure", Dimension::pressure},
                                                   {Q::drag, "drag", Dimension::force},
                                                   {Q::density, "density", Dimension::density}}};

/// Folded words of headings. `weak` words have other meanings in one of the languages: "last" is a load in German.
struct Word {
  std::string_view text;
  Quantity quantity;
  Quantity or_else = Q::other;
  bool weak = false;
};
constexpr Word words[]{
    {"drag", Q::drag},
    {"widerstand", Q::drag},
    {"trainee", Q::drag},
    {"weerstand", Q::drag},
    {"resistencia", Q::drag},
    {"arrastre", Q::drag},
    {"resistenza", Q::drag},

    {"stress", Q::stress},
    {"spannung", Q::stress, Q::other, true},
    {"contrainte", Q::stress},
    {"spanning", Q::stress, Q::other, true},
    {"esfuerzo", Q::stress, Q::force},
    {"sforzo", Q::stress, Q::force},
    {"tension", Q::force, Q::stress},
    {"tensione", Q::stress, Q::other, true},

    {"strain", Q::strain},
    {"dehnung", Q::strain, Q::extension},
    {"deformation", Q::strain, Q::extension},
    {"rek", Q::strain, Q::extension},
    {"vervorming", Q::strain, Q::extension},
    {"deformacion", Q::strain, Q::extension},
    {"deformazione", Q::strain, Q::extension},

    {"acceleration", Q::acceleration},
    {"accel", Q::acceleration},
    {"acc", Q::acceleration, Q::other, true},
    {"beschleunigung", Q::acceleration},
    {"versnelling", Q::acceleration},
    {"aceleracion", Q::acceleration},
    {"accelerazione", Q::acceleration},

    {"speed", Q::speed},
    {"velocity", Q::speed},
    {"airspeed", Q::speed},
    {"vel", Q::speed, Q::other, true},
    {"geschwindigkeit", Q::speed},
    {"vitesse", Q::speed},
    {"snelheid", Q::speed},
    {"velocidad", Q::speed},
    {"velocita", Q::speed},

    {"altitude", Q::altitude},
    {"alt", Q::altitude, Q::other, true},
    {"height", Q::altitude},
    {"elevation", Q::altitude},
    {"hohe", Q::altitude},
    {"hoehe", Q::altitude},
    {"hauteur", Q::altitude},
    {"hoogte", Q::altitude},
    {"altitud", Q::altitude},
    {"altura", Q::altitude},
    {"altitudine", Q::altitude},
    {"altezza", Q::altitude},
    {"quota", Q::altitude, Q::other, true},

    {"density", Q::density},
    {"dichte", Q::density},
    {"densite", Q::density},
    {"volumique", Q::density},
    {"dichtheid", Q::density},
    {"densidad", Q::density},
    {"densita", Q::density},

    {"pressure", Q::pressure},
    {"druck", Q::pressure},
    {"pression", Q::pressure},
    {"druk", Q::pressure},
    {"presion", Q::pressure},
    {"pressione", Q::pressure},

    {"force", Q::force},
    {"load", Q::force},
    {"kraft", Q::force},
    {"last", Q::force, Q::other, true},
    {"charge", Q::force, Q::other, true},
    {"effort", Q::force, Q::other, true},
    {"kracht", Q::force},
    {"belasting", Q::force},
    {"fuerza", Q::force},
    {"carga", Q::force, Q::other, true},
    {"forza", Q::force},
    {"carico", Q::force, Q::other, true},

    {"extension", Q::extension, Q::strain},
    {"displacement", Q::extension},
    {"elongation", Q::extension, Q::strain},
    {"stroke", Q::extension},
    {"travel", Q::extension},
    {"crosshead", Q::extension},
    {"deflection", Q::extension},
    {"position", Q::extension},
    {"weg", Q::extension},
    {"verlangerung", Q::extension, Q::strain},
    {"verlaengerung", Q::extension, Q::strain},
    {"langenanderung", Q::extension, Q::strain},
    {"laengenaenderung", Q::extension, Q::strain},
    {"verschiebung", Q::extension},
    {"traverse", Q::extension},
    {"deplacement", Q::extension},
    {"allongement", Q::extension, Q::strain},
    {"course", Q::extension, Q::other, true},
    {"verplaatsing", Q::extension},
    {"verlenging", Q::extension, Q::strain},
    {"desplazamiento", Q::extension},
    {"alargamiento", Q::extension, Q::strain},
    {"elongacion", Q::extension, Q::strain},
    {"carrera", Q::extension},
    {"posicion", Q::extension},
    {"spostamento", Q::extension},
    {"allungamento", Q::extension, Q::strain},
    {"corsa", Q::extension},
    {"posizione", Q::extension},
    {"estensione", Q::extension, Q::strain},

    {"time", Q::time},
    {"timestamp", Q::time},
    {"elapsed", Q::time},
    {"zeit", Q::time},
    {"zeitstempel", Q::time},
    {"temps", Q::time},
    {"tijd", Q::time},
    {"tiempo", Q::time},
    {"tempo", Q::time},

    {"specimen", Q::specimen},
    {"sample", Q::specimen},
    {"probe", Q::specimen},
    {"prufling", Q::specimen},
    {"pruefling", Q::specimen},
    {"eprouvette", Q::specimen},
    {"echantillon", Q::specimen},
    {"proefstuk", Q::specimen},
    {"monster", Q::specimen},
    {"probeta", Q::specimen},
    {"muestra", Q::specimen},
    {"provino", Q::specimen},
    {"campione", Q::specimen},
};

/// A heading with one of these is none of the quantities.
constexpr std::string_view vetoes[]{
    "rate",     "rates",       "coefficient",  "coeff",       "koeffizient", "beiwert", "area",
    "flache",   "flaeche",     "temperature",  "temperatur",  "temperatura", "voltage", "energy",
    "energie",  "energia",     "work",         "modulus",     "modul",       "module",  "modulo",
    "cycle",    "cycles",      "zyklus",       "count",       "limit",       "rata",    "preload",
    "vorkraft", "coeficiente", "coefficiente", "temperatuur", "uncertainty"};

struct Symbol {
  std::string_view text;
  Quantity quantity;
};
constexpr Symbol symbols[]{{"f", Q::force},   {"s", Q::extension},    {"t", Q::time},
                           {"ε", Q::strain},  {"σ", Q::stress},       {"h", Q::altitude},
                           {"v", Q::speed},   {"a", Q::acceleration}, {"p", Q::pressure},
                           {"ρ", Q::density}, {"rho", Q::density}};

/// "force1", "probe2"
std::string_view without_number(std::string_view token) {
  while (token.size() > 1 && token.back() >= '0' && token.back() <= '9') token.remove_suffix(1);
  return token;
}

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens(1);
  for (const char c : words_of(text)) {
    if (c == ' ')
      tokens.emplace_back();
    else
      tokens.back() += c;
  }
  for (std::string& token : tokens) token.resize(without_number(token).size());
  return tokens;
}

/// German and Dutch words that end compounds: "Standardkraft". Not words of other languages: an extension is no
/// tension.
constexpr std::string_view last_parts[]{"widerstand",
                                        "weerstand",
                                        "spannung",
                                        "spanning",
                                        "dehnung",
                                        "vervorming",
                                        "beschleunigung",
                                        "versnelling",
                                        "snelheid",
                                        "hohe",
                                        "hoehe",
                                        "geschwindigkeit",
                                        "hoogte",
                                        "dichte",
                                        "dichtheid",
                                        "druck",
                                        "druk",
                                        "kraft",
                                        "last",
                                        "kracht",
                                        "belasting",
                                        "verlangerung",
                                        "verlaengerung",
                                        "langenanderung",
                                        "laengenaenderung",
                                        "verschiebung",
                                        "verplaatsing",
                                        "verlenging",
                                        "zeit",
                                        "tijd",
                                        "weg",
                                        "probe",
                                        "prufling",
                                        "pruefling",
                                        "proefstuk"};

bool ends_with_part(std::string_view token, std::string_view part) {
  return token.size() >= part.size() + 2 && token.back() == part.back() && token.ends_with(part);
}

/// The listed words by their text.
const std::map<std::string_view, std::size_t>& places_of_words() {
  static const std::map<std::string_view, std::size_t> places = [] {
    std::map<std::string_view, std::size_t> made;
    for (std::size_t i = 0; i < std::size(words); ++i) made.emplace(words[i].text, i);
    return made;
  }();
  return places;
}

/// Adds the listed words that a token is ("load", "loads") or ends with ("standardkraft").
void add_words(std::set<std::size_t>& found, std::string_view token) {
  const std::map<std::string_view, std::size_t>& places = places_of_words();
  const auto add = [&](std::string_view text) {
    if (const auto place = places.find(text); place != places.end()) found.insert(place->second);
  };
  add(token);
  if (token.ends_with('s')) add(token.substr(0, token.size() - 1));
  for (const std::string_view part : last_parts)
    if (ends_with_part(token, part)) add(part);
}

/// Meanings of a name's words, in the order of the list above, which is that of precedence: drag force is a drag.
/// False: a veto.
bool find_meanings(Heading& heading, const std::string& name) {
  const std::vector<std::string> tokens = tokens_of(name);
  heading.weak = true;
  for (const std::string& token : tokens)
    for (const std::string_view veto : vetoes)
      if (token == veto || (veto.size() > 5 && token.ends_with(veto))) return false;
  const auto add = [&](Quantity quantity) {
    if (quantity != Q::other && std::count(heading.meanings.begin(), heading.meanings.end(), quantity) == 0)
      heading.meanings.push_back(quantity);
  };
  std::set<std::size_t> found;
  for (const std::string& token : tokens) add_words(found, token);
  for (const std::size_t place : found) {
    add(words[place].quantity);
    heading.weak = heading.weak && words[place].weak;
  }
  for (const std::size_t place : found) add(words[place].or_else);
  for (const Symbol& symbol : symbols)
    if (tokens.size() == 1 && tokens.front() == symbol.text) add(symbol.quantity);
  return true;
}

struct Bracketed {
  std::size_t begin = 0, end = 0;  // of the text, brackets included
  std::string inside;
};

std::vector<Bracketed> bracketed(const std::string& text) {
  std::vector<Bracketed> all;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '(' && c != '[' && c != '{' && c != '<') continue;
    const std::size_t kind = std::string_view("([{<").find(c);
    const std::size_t end = text.find(std::string_view(")]}>")[kind], i);
    if (end == std::string::npos) continue;
    all.push_back({i, end + 1, trimmed(std::string_view(text).substr(i + 1, end - i - 1))});
    i = end;
  }
  return all;
}

std::string without(const std::string& text, const std::vector<Bracketed>& parts) {
  std::string rest = text;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
    rest.replace(part->begin, part->end - part->begin, " ");
  return trimmed(rest);
}

/// A unit after a comma, slash, underscore or blank at the end of the name; cut off there.
void take_trailing_unit(Heading& heading) {
  const std::string& name = heading.name;
  for (std::size_t i = 1; i + 1 < name.size(); ++i) {
    const char mark = name[i];
    if (std::string_view(",/_ ").find(mark) == std::string_view::npos) continue;
    std::string unit = trimmed(std::string_view(name).substr(i + 1));
    std::string before = trimmed(std::string_view(name).substr(0, i));
    if (mark == ' ' && unit.starts_with("in ")) unit = trimmed(std::string_view(unit).substr(3));
    if (const std::size_t per = unit.find("_per_"); per != std::string::npos) unit.replace(per, 5, "/");
    if (mark == '_') std::replace(unit.begin(), unit.end(), '_', '/');
    const bool stated = mark == ',' || mark == '/';
    const bool number = unit == "-" || unit == "1";
    if (unit.empty() || before.empty() || (number && !stated)) continue;
    if (!is_unit(unit) && clock_form(unit) == ClockForm::none) continue;
    Heading rest;
    find_meanings(rest, without(before, bracketed(before)));
    rest.name = before;
    if (rest.meanings.empty()) continue;
    if (meaning_in(rest, unit) == Q::other && !(stated && !number)) continue;
    heading.unit = unit;
    heading.name = before;
    return;
  }
}

}  // namespace

bool may_have_meaning(std::string_view words) {
  const auto is_word = [](std::string_view token) { return places_of_words().contains(token); };
  while (!words.empty()) {
    std::string_view token = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(token.size() + 1, words.size()));
    token = without_number(token);
    if (is_word(token) || (token.ends_with('s') && is_word(token.substr(0, token.size() - 1)))) return true;
    for (const Symbol& symbol : symbols)
      if (token == symbol.text) return true;
    for (const std::string_view part : last_parts)
      if (ends_with_part(token, part)) return true;
  }
  return false;
}

std::string name_of(Quantity quantity) {
  for (const QuantityName& known : quantities)
    if (known.quantity == quantity) return known.name;
  return quantity == Q::specimen ? "specimen" : "other";
}

std::optional<Quantity> quantity_named(std::string_view name) {
  for (const QuantityName& known : quantities)
    if (name == known.name) return known.quantity;
  return {};
}

std::string quantity_names() {
  std::string list;
  for (const QuantityName& known : quantities) list += (list.empty() ? "" : ", ") + std::string(known.name);
  return list;
}

Dimension dimension_of(Quantity quantity) {
  for (const QuantityName& known : quantities)
    if (known.quantity == quantity) return known.dimension;
  return Dimension::fraction;
}

std::string bare_unit(const std::string& text) {
  const std::vector<Bracketed> parts = bracketed(text);
  return parts.size() == 1 && parts[0].begin == 0 && parts[0].end == text.size() ? parts[0].inside : text;
}

ClockForm clock_form(const std::string& unit) {
  if (unit.find(':') == std::string::npos) return ClockForm::none;
  std::string letters;
  for (const char c : folded(unit))
    if (c == ':' || (c >= 'a' && c <= 'z')) letters += c;
  const auto is = [&](std::initializer_list<const char*> texts) {
    return std::any_of(texts.begin(), texts.end(), [&](const char* text) {
      const std::string_view rest = letters;
      return rest.starts_with(text) &&
             rest.substr(std::string_view(text).size()).find_first_not_of("sfx") == std::string_view::npos;
    });
  };
  if (is({"hh:mm:ss", "h:mm:ss", "h:m:s", "h:min:s"})) return ClockForm::hours_minutes_seconds;
  if (is({"mm:ss", "m:ss", "m:s", "min:s", "min:sec"})) return ClockForm::minutes_seconds;
  if (letters == "hh:mm" || letters == "h:mm" || letters == "h:min") return ClockForm::hours_minutes;
  return ClockForm::none;
}

Quantity meaning_in(const Heading& heading, const std::string& unit) {
  for (const Quantity quantity : heading.meanings) {
    if (quantity == Q::specimen) continue;
    if (find_unit(dimension_of(quantity), unit)) return quantity;
    if (quantity == Q::time && clock_form(unit) != ClockForm::none) return quantity;
  }
  return Q::other;
}

Heading read_heading(const std::string& text) {
  Heading heading;
  heading.text = trimmed(text);
  if (heading.text.size() > 300) return heading;
  std::vector<Bracketed> parts = bracketed(heading.text);
  heading.name = heading.text;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (!is_unit(part->inside) && clock_form(part->inside) == ClockForm::none) continue;
    if (!heading.unit.empty()) {
      const bool number = part->inside == "1" || part->inside == "-";
      if (!number && part->inside != heading.unit) heading.other_unit = part->inside;
      continue;
    }
    heading.unit = part->inside;
    heading.name.replace(part->begin, part->end - part->begin, " ");
    heading.name = trimmed(heading.name);
  }
  parts = bracketed(heading.name);
  if (heading.unit.empty() && parts.size() == 1) heading.odd = parts.front().inside;
  if (heading.unit.empty()) take_trailing_unit(heading);
  if (find_meanings(heading, without(heading.name, bracketed(heading.name))))
    for (const Bracketed& part : parts)
      if (heading.meanings.empty()) find_meanings(heading, part.inside);
  heading.clock = clock_form(heading.unit);
  return heading;
}

}  // namespace ripstop::table
