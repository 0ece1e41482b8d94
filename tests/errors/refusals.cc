/// refusals FILE.prm ...: wrong input is refused.
///
/// The first line of a file is "# EXPECT: regex"; a line "# OPTIONS: ..." after it adds options. The program must leave
/// with exit code 1, say one sentence that matches, and leave no files behind; with --check as well, unless a line
/// "# NOT BY CHECK: reason" says why that cannot know.

#include "../run_in_copy.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>
#include <wordexp.h>

namespace
{
  namespace fs = std::filesystem;

  constexpr std::size_t longest_message = 700;

  std::string text_of(const fs::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Removed with all that is in it.
  struct Folder
  {
    Folder()
    {
      std::string name = fs::temp_directory_path() / "refusals_XXXXXX";
      if (!mkdtemp(name.data()))
        throw std::runtime_error("no temporary folder could be made");
      path = name;
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    fs::path path;
  };

  struct Expected
  {
    std::string message, options;
    bool by_check = true;
  };

  Expected expected_of(const std::string &file)
  {
    Expected expected;
    std::ifstream stream(file);
    std::string line;
    const auto rest_behind = [&](const std::string &begin)
    { return line.rfind(begin, 0) == 0 ? line.substr(begin.size()) : ""; };
    for (unsigned int number = 1; std::getline(stream, line); ++number)
    {
      if (number == 1)
        expected.message = rest_behind("# EXPECT: ");
      if (number == 2 || number == 3)
        expected.options += rest_behind("# OPTIONS: ");
      if (line.rfind("# NOT BY CHECK: ", 0) == 0)
        expected.by_check = false;
    }
    if (expected.message.empty())
      throw std::runtime_error("the first line is not '# EXPECT: regex'");
    return expected;
  }

  /// As a shell splits them.
  std::vector<std::string> words_of(const std::string &options)
  {
    wordexp_t words;
    if (wordexp(options.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) != 0)
      throw std::runtime_error("no shell takes the options " + options);
    std::vector<std::string> result(words.we_wordv, words.we_wordv + words.we_wordc);
    wordfree(&words);
    return result;
  }

  struct Refusal
  {
    std::string message;
    /// whether something was said on the screen before
    bool began = false;
  };

  /// @throws std::runtime_error naming what is not as expected
  Refusal refusal(const std::string &file, const std::string &options, const Expected &expected)
  {
    const Folder folder;
    const fs::path work = folder.path / "work", screen = folder.path / "screen",
                   message = folder.path / "message";
    fs::create_directory(work);
    std::vector<std::string> arguments = words_of(options);
    arguments.insert(arguments.begin(), file);
    const int status = status_of({arguments, work, screen, message, LONGEST_RUN});
    const std::string said = text_of(message);
    const auto check = [&](const bool good, const std::string &what)
    {
      if (!good)
        throw std::runtime_error(what + " with options " + options + "\nexpected: " + expected.message +
                                 "\nmessage:  " + said);
    };
    check(WIFEXITED(status), "ended by signal " + std::to_string(WTERMSIG(status)));
    check(WEXITSTATUS(status) == 1, "exit code " + std::to_string(WEXITSTATUS(status)) + " instead of 1");
    check(!said.empty() && said.find('\n') + 1 == said.size(), "the message is not one line");
    check(said.size() <= longest_message, "the message is too long");
    check(std::regex_search(said.substr(0, said.size() - 1),
                            std::regex(expected.message, std::regex::extended)),
          "the message does not match");
    check(fs::is_empty(work), "files are left behind");
    return {said, fs::file_size(screen) > 0};
  }

  /// @return whether a file is refused as expected
  bool is_refused(const std::string &file)
  {
    try
    {
      const Expected expected = expected_of(file);
      const Refusal whole = refusal(file, expected.options, expected);
      std::cout << whole.message << std::flush;
      if (whole.began && expected.by_check && expected.options.find("--check") == std::string::npos)
        refusal(file, expected.options + " --check", expected);
      return true;
    }
    catch (const std::exception &error)
    {
      std::cout << "FAILED: " << file << ": " << error.what() << std::endl;
      return false;
    }
  }
} // namespace

int main(const int argc, char **argv)
{
  unsigned int n_wrong = 0;
  for (int i = 1; i < argc; ++i)
    n_wrong += !is_refused(fs::canonical(argv[i]));
  std::cout << argc - 1 << " files, " << n_wrong << " not refused as expected" << std::endl;
  return argc > 1 && n_wrong == 0 ? 0 : 1;
}
