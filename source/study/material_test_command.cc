// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/material_test_command.h>

#include <moraine/core/console.h>
#include <moraine/core/exit.h>
#include <moraine/core/words.h>
#include <moraine/output/component_names.h>
#include <moraine/output/history.h>
#include <moraine/output/on_root.h>
#include <moraine/scene/scene.h>
#include <moraine/study/study_report.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What a scene says of the test of one of its materials. */
    struct TestedMaterial
    {
      std::shared_ptr<const Material> material;
      MaterialTestParameters          test;
      StrainMeasure                   measure;
      Units                           units;
    };



    template <int dim>
    TestedMaterial
    read_tested_material(const InputFile &input, std::string &name)
    {
      const Scene<dim>         scene(input, true);
      std::vector<std::string> names;
      for (const auto &[known, parameters] : scene.materials)
        names.push_back(known);
      if (name.empty() && names.size() == 1)
        name = names[0];
      for (const auto &[known, parameters] : scene.materials)
        if (known == name)
          return {scene.strength_reduction.reduced(
                    name, make_material(parameters, "Materials/" + name)),
                  scene.study.material_test,
                  scene.method.strain_measure(),
                  scene.output.units};
      throw InputError("section 'Materials': option '--material': found '" +
                       name + "', allowed: " + list_of(names) +
                       (name.empty() || nearest(name, names).empty() ?
                          "" :
                          "; did you mean '" + nearest(name, names) + "'?"));
    }



    /** @throw InputError if a parameter depends on place: a point of a test is
     * nowhere. */
    void
    check_places(const Material &material, const std::string &section)
    {
      for (const InternalVariable &variable : material.internal_variables())
        if (variable.initial_at)
          throw InputError("section '" + section + "': '" + variable.name +
                           "' depends on place, allowed in a material test: a "
                           "number");
    }



    /** @throw InputError for an initial stress that @p test does not have. */
    void
    check_initial_stress(const TestedMaterial &of, const MaterialTest &test)
    {
      const SymmetricTensor<2, 3> wanted = of.test.stress();
      if (of.measure == StrainMeasure::small &&
          !of.material->has_small_strain_limit())
        reject("Method",
               "Strain",
               "small",
               "finite; the material makes no sense at small strain");
      if (!((test.stress() - wanted).norm() <= 1e-9 * wanted.norm()))
        {
          std::string has;
          for (unsigned int I = 0; I < 6; ++I)
            has +=
              (I > 0 ? ", " : "") +
              text_of(
                test.stress()
                  [SymmetricTensor<2, 3>::unrolled_to_component_indices(I)]);
          std::string found;
          for (const double value : of.test.initial_stress)
            found += (found.empty() ? "" : ", ") + text_of(value);
          reject("Material test",
                 "Initial stress",
                 found,
                 "a stress that the material can have; it makes of this " +
                   has);
        }
    }



    /** Its sign tells whether z is compressed most. */
    double
    with_sign_of_axis(const double                 size,
                      const SymmetricTensor<2, 3> &tensor,
                      const bool                   has_axis)
    {
      return has_axis && tensor[2][2] > 0.5 * (tensor[0][0] + tensor[1][1]) ?
               -size :
               size;
    }



    std::vector<NamedValue>
    row_of_test(const TestedMaterial &of,
                const MaterialTest   &test,
                const unsigned int    leg,
                const unsigned int    step)
    {
      const MaterialTestParameters &parameters = of.test;
      const SymmetricTensor<2, 3>  &stress     = test.stress();
      SymmetricTensor<2, 3>         strain;
      for (unsigned int I = 0; I < 6; ++I)
        strain[SymmetricTensor<2, 3>::unrolled_to_component_indices(I)] =
          (I < 3 ? 1. : 0.5) * test.strain()[I];
      std::vector<NamedValue> row{{"leg", "-", double(leg)},
                                  {"step", "-", double(step)}};
      const auto              components = [&](const std::string           &name,
                                  const std::string           &unit,
                                  const SymmetricTensor<2, 3> &tensor) {
        for (unsigned int I = 0; I < 6; ++I)
          row.push_back(
            {name + stress_component_name(I),
             unit,
             tensor[SymmetricTensor<2, 3>::unrolled_to_component_indices(I)]});
      };
      components("eps_", "-", strain);
      components("sigma_", "stress", stress);
      const double p           = trace(stress) / 3;
      const auto   signed_size = [&](const double                 factor,
                                   const SymmetricTensor<2, 3> &tensor) {
        return with_sign_of_axis(std::sqrt(factor) * deviator(tensor).norm(),
                                 tensor,
                                 parameters.has_axis());
      };
      row.push_back({"p", "stress", p});
      row.push_back({"p_compression", "stress", 0. - p});
      row.push_back({"q", "stress", signed_size(1.5, stress)});
      row.push_back({"eps_v", "-", trace(strain)});
      row.push_back({"eps_q", "-", signed_size(2. / 3, strain)});
      if (parameters.has_axis())
        row.push_back({"axial_compression", "-", 0. - strain[2][2]});
      if (parameters.shears())
        row.push_back({"gamma_xz", "-", test.strain()[4]});
      if (const int d = parameters.drained_component(); d >= 0)
        {
          const double u = stress[d][d] - parameters.stress()[d][d];
          row.push_back({"excess_pore_pressure", "stress", u});
          row.push_back({"p_total", "stress", p - u});
        }
      const auto variables = of.material->internal_variables();
      for (unsigned int v = 0; v < variables.size(); ++v)
        row.push_back(
          {variables[v].name, variables[v].unit, test.internal()[v]});
      row.push_back({"iterations", "-", double(test.n_iterations())});
      row.push_back({"tangent_error", "-", test.tangent_error()});
      return row;
    }



    /** The path of the measured values, as seen from here; none if empty.
     * @throw InputError if they cannot be read. */
    std::string
    measured_values(const InputFile &input, const std::string &file)
    {
      if (file.empty())
        return "";
      const auto path =
        std::filesystem::path(input.name()).parent_path() / file;
      if (!std::ifstream(path) || std::filesystem::is_directory(path))
        reject("Material test", "Measured", file, "a CSV file that is there");
      return path.string();
    }



    /** By 'moraine plot', a script that this program starts. */
    void
    draw_test(const std::string &stem,
              const std::string &measured,
              Console           &console)
    {
      std::error_code   ignored;
      const std::string command =
        one_word(
          std::filesystem::read_symlink("/proc/self/exe", ignored).string()) +
        " plot " + one_word(stem + ".csv") +
        (measured.empty() ? "" : " --measured " + one_word(measured));
      if (std::system((command + " >/dev/null").c_str()) == 0)
        console << "  picture in " << stem << ".png" << std::endl;
      else
        console << "  no picture; try: " << command << std::endl;
    }
  } // namespace



  int
  test_material(const InputFile   &input,
                const std::string &material,
                const std::string &folder,
                const MPI_Comm     communicator)
  {
    std::string          name = material;
    const TestedMaterial of   = input.get("", "Dimension", "2") == "3" ?
                                  read_tested_material<3>(input, name) :
                                  read_tested_material<2>(input, name);
    check_places(*of.material, "Materials/" + name);
    const auto        legs     = of.test.all_legs();
    const std::string measured = measured_values(input, of.test.measured);
    MaterialTest      test(of.material, of.measure, of.test.stress());
    check_initial_stress(of, test);

    Console           console(communicator);
    const std::string file = folder + "/material-test-" + name;
    on_root(communicator, [&]() {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error)
        throw InputError("cannot make the folder " + folder + ": " +
                         error.message());
    });
    History      history(file + ".csv", communicator, of.units);
    unsigned int step = 0;
    history.add_row(row_of_test(of, test, 0, step));
    for (unsigned int l = 0; l < legs.size(); ++l)
      try
        {
          test.lead(legs[l], [&]() {
            history.add_row(row_of_test(of, test, l + 1, ++step));
          });
        }
      catch (const ComputationError &error)
        {
          throw ComputationError(
            "section 'Material test': leg " + std::to_string(l + 1) + ", '" +
            legs[l].text + "', step " + std::to_string(step + 1) + ": " +
            error.what() + "; the steps before are in " + file + ".csv");
        }
    console << of.test.kind << " test of '" << name << "': " << legs.size()
            << " legs, " << step << " steps\n  results in " << file << ".csv"
            << std::endl;
    on_root(communicator, [&]() { draw_test(file, measured, console); });
    return done;
  }
} // namespace moraine
