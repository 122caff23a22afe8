// The table of the material library and the entry of one material.
#include "ripstop/run/material/materials.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/file.h"
#include "ripstop/material/permeability.h"
#include "ripstop/material/spring_law.h"
#include "ripstop/material/strength.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

TEST(Materials, ListsEveryMaterialOfTheLibraryByKind) {
  const MaterialList list = library_materials();
  ASSERT_EQ(list.materials.size(), library_names().size());
  EXPECT_TRUE(std::is_sorted(list.materials.begin(), list.materials.end(), [](const auto& a, const auto& b) {
    return std::pair(a.kind, a.name) < std::pair(b.kind, b.name);
  }));
  for (const MaterialEntry& m : list.materials) {
    EXPECT_FALSE(m.source.empty()) << m.name;
    EXPECT_NE(m.areal_density.has_value(), m.linear_density.has_value()) << m.name;
    EXPECT_NE(m.strength_per_width.has_value(), m.strength.has_value()) << m.name;
    EXPECT_EQ(m.kind == "fabric", m.areal_density.has_value()) << m.name;
    EXPECT_EQ(kind_of(library_material(m.name)), m.kind);
    EXPECT_TRUE(std::filesystem::exists(m.file)) << m.file;
  }
}

TEST(Materials, OfAClothHaveItsLawAlongBothYarnsAndItsPermeability) {
  const MaterialEntry m = material_entry("f-111-physical");
  const Fabric cloth = std::get<Fabric>(library_material("f-111-physical"));
  EXPECT_EQ(m.areal_density, cloth.areal_density_kg_m2);
  EXPECT_EQ(m.strength_per_width, cloth.break_load_n_m);
  ASSERT_FALSE(m.curve.empty());
  EXPECT_EQ(m.curve.back().strain, cloth.tested_strain);
  EXPECT_EQ(m.curve.back().warp, SpringLaw{cloth.coefficients_n_m}.tension(cloth.tested_strain));
  EXPECT_FALSE(m.curve.back().tension);
  EXPECT_NEAR(*m.permeability_cfm, 3, 1e-3);
  const PressureDrop law = as_sheet(cloth.resistance);
  for (const MaterialFlow& p : m.air) EXPECT_NEAR(pressure_drop(law, p.velocity) / p.pressure, 1, 1e-9);
  EXPECT_FALSE(material_entry("f-111").permeability) << "its coefficients are those of porous cells";
  EXPECT_TRUE(material_entry("f-111").air.empty());
}

TEST(Materials, OfATapeHaveTheTensionOfItsWidth) {
  const MaterialEntry m = material_entry("nylon-tape-200-lbf");
  const Tape tape = std::get<Tape>(library_material("nylon-tape-200-lbf"));
  EXPECT_EQ(m.strength, tape.break_load_n);
  EXPECT_NEAR(*m.curve.back().tension / tape.break_load_n, 1, 1e-3);  // at the tested strain, by its file
  EXPECT_FALSE(m.curve.back().warp);
}

TEST(Materials, OfAFileAreReadAndAnUnknownNameGivesTheNearest) {
  const TemporaryFolder folder("materials");
  write_file(folder.path / "mine.toml", read_file(data_directory() / "materials/spectra-line.toml"));
  MaterialEntry mine = material_entry((folder.path / "mine.toml").string());
  EXPECT_EQ(mine.name, "mine");
  mine.name = "spectra-line", mine.file = material_entry("spectra-line").file;
  EXPECT_EQ(to_json(MaterialList{{mine}}), to_json(MaterialList{{material_entry("spectra-line")}}));
  EXPECT_NE(refusal_of([] { material_entry("spectra-lin"); }, ExitCode::usage)
                .find("did you mean \"spectra-line\"?"),
            std::string::npos);
  const auto json = nlohmann::json::parse(to_json(library_materials()));
  EXPECT_EQ(json.at("materials").size(), library_names().size());
}

}  // namespace
}  // namespace ripstop
