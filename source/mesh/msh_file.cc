// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/msh_file.h>

#include <map>
#include <set>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** What parts of the file say about it. */
    class MshFile
    {
    public:
      explicit MshFile(std::istream &in)
        : in(in)
      {}

      std::string
      complaint()
      {
        std::string word;
        if (!(in >> word) || word != "$MeshFormat")
          return "it does not begin with $MeshFormat";
        double       version;
        unsigned int is_binary, size_of_number;
        if (!(in >> version >> is_binary >> size_of_number))
          return "$MeshFormat has no version";
        if (!(version >= 2 && version < 3) && version != 4 && version != 4.1)
          {
            std::ostringstream text;
            text << "it has format " << version;
            return text.str();
          }
        if (is_binary != 0)
          return "it is binary";
        is_version_2   = version < 3;
        is_version_4_0 = version == 4;
        if (!find("$EndMeshFormat") || !find("$Nodes"))
          return "it has no section $Nodes";
        if (!read_nodes() || !(in >> word) || word != "$EndNodes")
          return "section $Nodes is not complete";
        if (!find("$Elements"))
          return "it has no section $Elements";
        if (!read_elements() || !(in >> word) || word != "$EndElements")
          return wrong_element.empty() ? "section $Elements is not complete" :
                                         wrong_element;
        return "";
      }

    private:
      /** Go on behind this word; sections on the way must end. */
      bool
      find(const std::string &name)
      {
        std::string word, open;
        while (in >> word)
          {
            if (word == name)
              return open.empty();
            if (word.rfind("$End", 0) == 0)
              open.clear();
            else if (word[0] == '$')
              open = word;
          }
        return false;
      }

      bool
      skip_numbers(const std::size_t n)
      {
        double number;
        for (std::size_t i = 0; i < n; ++i)
          if (!(in >> number))
            return false;
        return true;
      }

      bool
      read_tags(const std::size_t n)
      {
        std::size_t tag;
        for (std::size_t i = 0; i < n; ++i)
          {
            if (!(in >> tag))
              return false;
            nodes.insert(tag);
          }
        return true;
      }

      bool
      read_nodes()
      {
        std::size_t n_blocks = 1, n_nodes = 0;
        if (is_version_2)
          in >> n_nodes;
        else
          {
            in >> n_blocks >> n_nodes;
            skip_numbers(is_version_4_0 ? 0 : 2);
          }
        for (std::size_t block = 0; in && block < n_blocks; ++block)
          {
            std::size_t n = n_nodes, n_coordinates = 3;
            if (!is_version_2)
              {
                std::size_t a = 0, b = 0, is_parametric = 0;
                in >> a >> b >> is_parametric >> n;
                if (is_parametric != 0)
                  n_coordinates += is_version_4_0 ? b : a;
              }
            const bool tags_first = !is_version_2 && !is_version_4_0;
            if (!in || (tags_first && !read_tags(n)))
              return false;
            for (std::size_t i = 0; i < n; ++i)
              if ((!tags_first && !read_tags(1)) ||
                  !skip_numbers(n_coordinates))
                return false;
          }
        return in && nodes.size() == n_nodes;
      }

      bool
      read_element(const std::size_t type, const std::size_t n_tags)
      {
        static const std::map<std::size_t, unsigned int> n_nodes{
          {1, 2}, {2, 3}, {3, 4}, {4, 4}, {5, 8}, {6, 6}, {7, 5}, {15, 1}};
        if (n_nodes.count(type) == 0)
          {
            wrong_element = "it has elements of gmsh's type " +
                            std::to_string(type) + ", which are not linear";
            return false;
          }
        if (!skip_numbers(n_tags))
          return false;
        for (unsigned int i = 0; i < n_nodes.at(type); ++i)
          {
            std::size_t node;
            if (!(in >> node))
              return false;
            if (nodes.count(node) == 0)
              {
                wrong_element = "an element has node " + std::to_string(node) +
                                ", which is not there";
                return false;
              }
          }
        return true;
      }

      bool
      read_elements()
      {
        std::size_t n_blocks = 1, n_elements = 0;
        if (!is_version_2)
          in >> n_blocks;
        in >> n_elements;
        if (!is_version_2 && !is_version_4_0)
          skip_numbers(2);
        for (std::size_t block = 0; in && block < n_blocks; ++block)
          {
            std::size_t n = n_elements, type = 0;
            if (!is_version_2)
              {
                skip_numbers(2);
                in >> type >> n;
              }
            for (std::size_t i = 0; in && i < n; ++i)
              {
                std::size_t tag, n_tags = 0;
                in >> tag;
                if (is_version_2)
                  in >> type >> n_tags;
                if (!in || !read_element(type, n_tags))
                  return false;
              }
          }
        return static_cast<bool>(in);
      }

      std::istream         &in;
      bool                  is_version_2   = false;
      bool                  is_version_4_0 = false;
      std::set<std::size_t> nodes;
      std::string           wrong_element;
    };
  } // namespace



  std::string
  complaint_about_msh(std::istream &in)
  {
    return MshFile(in).complaint();
  }



  std::vector<std::pair<std::string, unsigned int>>
  physical_names_of_msh(std::istream &in, const unsigned int dimension)
  {
    std::vector<std::pair<std::string, unsigned int>> names;
    std::string                                       word;
    while (in >> word && word != "$PhysicalNames")
      {}
    std::size_t n = 0;
    in >> n;
    for (std::size_t i = 0; i < n; ++i)
      {
        unsigned int group_dimension, number;
        std::string  name;
        if (!(in >> group_dimension >> number) ||
            !std::getline(in >> std::ws, name))
          break;
        const auto first = name.find('"'), last = name.rfind('"');
        if (group_dimension == dimension && first < last)
          names.emplace_back(name.substr(first + 1, last - first - 1), number);
      }
    return names;
  }
} // namespace moraine
