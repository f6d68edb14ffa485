// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/parameter_reference.h>

#include <moraine/core/patterns.h>
#include <moraine/scene/scene.h>

// Keeps boost 1.74 from printing a note about its own code.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    using Tree = boost::property_tree::ptree;



    /** deal.II's entries hold their pattern; sections hold only trees. */
    bool
    is_entry(const Tree &node)
    {
      const auto pattern = node.find("pattern_description");
      return pattern != node.not_found() && pattern->second.empty();
    }



    /** Text that does not end a cell of a table or begin an HTML tag. */
    std::string
    in_cell(const std::string &text)
    {
      std::string cell;
      for (const char c : text)
        cell += c == '|'  ? std::string("\\|") :
                c == '<'  ? std::string("&lt;") :
                c == '>'  ? std::string("&gt;") :
                c == '*'  ? std::string("\\*") :
                c == '\n' ? std::string(" ") :
                            std::string(1, c);
      return cell;
    }



    void
    print_section(const Tree &node, const std::string &path, std::ostream &out)
    {
      bool has_entries = false;
      for (const auto &[name, child] : node)
        if (is_entry(child))
          {
            if (!has_entries)
              out << "\n## " << (path.empty() ? "(top)" : in_cell(path))
                  << "\n\n| key | default | allowed | meaning |\n"
                  << "|---|---|---|---|\n";
            has_entries        = true;
            const auto initial = child.get<std::string>("default_value");
            out << "| " << name << " | "
                << (initial.empty() ? "" : "`" + initial + "`") << " | "
                << in_cell(
                     describe(child.get<std::string>("pattern_description")))
                << " | " << in_cell(child.get<std::string>("documentation"))
                << " |\n";
          }
      for (const auto &[name, child] : node)
        if (!is_entry(child))
          print_section(child, path.empty() ? name : path + "/" + name, out);
    }



    template <int dim>
    void
    print(std::ostream &out)
    {
      Scene<dim>        scene;
      std::stringstream json;
      scene.parameters().print_parameters(
        json, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
      Tree tree;
      boost::property_tree::read_json(json, tree);
      out
        << "# Parameters in " << dim << "D\n\n"
        << "Written by `moraine parameters --dimension " << dim
        << "`. A heading is the path of a section; `<name>` is any name "
           "you like.\nUnits are yours: length, stress, time and mass have "
           "to fit each other.\nSection `Constants` holds names of your own: "
           "with `set h = 0.2` there, `$h` in any value stands for 0.2.\n"
           "Where a number is wanted, arithmetic gives it: `100/7`, `2*$h`, "
           "`sqrt(2)*pi`, in lists too; a constant that is arithmetic or an expression stands "
           "for its value. In tables and lists that blanks separate, write "
           "it without blanks.\n";
      print_section(tree, "", out);
    }
  } // namespace



  void
  print_parameter_reference(const unsigned int dimension, std::ostream &out)
  {
    if (dimension == 2)
      print<2>(out);
    else
      print<3>(out);
  }
} // namespace moraine
