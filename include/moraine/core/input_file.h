// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_input_file_h
#define moraine_core_input_file_h

#include <moraine/core/exceptions.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace moraine
{
  /**
   * A .prm file as the user wrote it: lines `subsection NAME`, `set KEY =
   * VALUE`, `end`, comments after `#`, and lines continued by a `\` at their
   * end, as deal.II reads them. The text is scanned before anything is
   * declared, so that the free names of materials, bodies and boundaries are
   * known in time, and so that mistakes deal.II lets pass (a key set twice) are
   * found.
   *
   * Every mistake is an InputError whose message begins with file and line and
   * names section, key, what was found and what is allowed.
   *
   * Sections are named by their path, joined by '/': "Materials/clay".
   */
  class InputFile
  {
  public:
    /** One `set KEY = VALUE`. */
    struct Entry
    {
      std::string section;
      std::string key;
      std::string value;
      /** Where it stands: "scene.prm:12", or "--set 'Mesh/Cell size = 5'". */
      std::string origin;
    };

    /**
     * Read and scan a file. On many ranks every rank reads it; call it on all.
     */
    static InputFile
    read(const std::string &path);

    /** Scan @p text; @p name stands for the file in messages. */
    static InputFile
    from_text(const std::string &name, const std::string &text);

    /**
     * Apply `--set "Section/Sub/Key = value"`: replaces the value where the key
     * is set, else adds it. A section "*" stands for every name there is in its
     * place. Whether the key exists is judged by parse().
     * @throw InputError for a text that is no setting.
     */
    void
    apply_override(const std::string &setting);

    /** What apply_override() was given, in order. */
    const std::vector<std::string> &
    overrides() const
    {
      return applied;
    }

    /**
     * The same file with the value of one entry of entries() replaced; messages
     * still name the line of the file.
     */
    InputFile
    with_value(const std::size_t entry, const std::string &value) const;

    /** All entries in the order of the file. */
    const std::vector<Entry> &
    entries() const;

    /** Whether the file or an override sets the key. */
    bool
    has(const std::string &section, const std::string &key) const;

    /** Value of a key, its constants replaced, or @p fallback if not set. */
    std::string
    get(const std::string &section,
        const std::string &key,
        const std::string &fallback) const;

    /**
     * Value of a key that has no default.
     * @throw InputError if it is not set.
     */
    std::string
    require(const std::string &section, const std::string &key) const;

    /** Names of the subsections directly in @p section, in order. */
    std::vector<std::string>
    names_in(const std::string &section) const;

    /**
     * A message that begins by naming a section or key, with its place in
     * front: "scene.prm:12: ...", or the file alone if it does not stand there.
     * Other messages stay as they are.
     */
    std::string
    located(const std::string &message) const;

    /** Name given or path read. */
    const std::string &
    name() const;

    /** A complete input file: the text with overrides applied. */
    std::string
    text() const;

    /**
     * Set every entry in @p prm, where everything is declared. Where a pattern
     * wants numbers, arithmetic as "2*$E" or "100/7" gives them.
     * @return the entries whose value is not the default, constants replaced.
     * @throw InputError for a section or key that is not declared, and for a
     * value its pattern refuses. The handler is then partly set.
     */
    std::vector<Entry>
    parse(dealii::ParameterHandler &prm) const;

  private:
    /** A line of text (continued lines together) and where it comes from. */
    struct Line
    {
      std::string text;
      std::string origin;
    };

    /**
     * The values of entries() with every `$name` replaced by the value of key
     * `name` in section `Constants`, so that a scene (or a study) says a value
     * once. A constant sees those before it only; one that is arithmetic
     * ("100/7", "2*$b") stands for its number.
     *
     * @throw InputError for a name that section does not have.
     */
    std::vector<std::string>
    values() const;

    void
    scan();

    void
    scan_entry(const std::size_t line, const std::string &statement);

    /** The section whose keys are names for values. */
    inline static const std::string constants_section{"Constants"};

    std::string              file_name;
    std::vector<std::string> applied; ///< overrides
    std::vector<Line>        lines;
    std::vector<Entry>       found_entries;
    std::vector<std::size_t> line_of_entry;

    /** Paths of all sections, in order, and where each first stands. */
    std::vector<Line> sections;

    /** While scanning: the open sections, and the line that opened each. */
    std::vector<Line> open_sections;
  };

  /** @throw InputError about the value of an entry. */
  [[noreturn]] inline void
  reject(const InputFile::Entry &entry, const std::string &allowed)
  {
    reject(entry.section, entry.key, entry.value, allowed);
  }
} // namespace moraine

#endif
