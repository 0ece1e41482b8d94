#include <vibrocontact/base/command_line.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    namespace options = boost::program_options;

    options::options_description visible_options()
    {
      options::options_description description("Options");
      description.add_options()(
          "output", options::value<std::string>()->value_name("DIR"),
          "folder for the results (default: the entry Output/Directory, by default results/<name of FILE>)")(
          "set", options::value<std::vector<std::string>>()->value_name("\"Section/Sub/Entry=value\""),
          "override an entry; may be repeated; checked like the file")(
          "check", "read and validate the file and its meshes, print the scene, run nothing")(
          "parameters", "print every parameter with its default, pattern, meaning and unit, as a valid file")(
          "resume", "continue the run in the output folder from its newest checkpoint")(
          "quiet", "write to the log file only, not to the screen")("version", "print the version")(
          "help", "print this text");
      return description;
    }
  } // namespace

  std::string command_line_help()
  {
    std::ostringstream text;
    text << "vibrocontact FILE.prm [options]\nmpirun -n 2 vibrocontact FILE.prm [options]\n\n"
         << visible_options()
         << "\nExit code: 0 all analyses converged; 1 wrong input, or an output folder that nothing can be "
            "written\n"
            "to; 2 a computation did not converge; 3 a fault of the program, or results that cannot be "
            "written\n"
            "any more; 130 or 143: stopped by SIGINT or SIGTERM during a transient, --resume continues.\n";
    return text.str();
  }

  CommandLine read_command_line(const int argc, const char *const *argv)
  {
    options::options_description all = visible_options();
    all.add_options()("file", options::value<std::vector<std::string>>());
    options::positional_options_description positional;
    positional.add("file", -1);

    options::variables_map given;
    try
    {
      // No guessing: an abbreviated option is a typing error.
      const int style =
          options::command_line_style::default_style & ~options::command_line_style::allow_guessing;
      options::store(
          options::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
          given);
    }
    catch (const options::unknown_option &error)
    {
      std::vector<std::string> names;
      const options::options_description visible = visible_options();
      for (const auto &option : visible.options())
        names.push_back("--" + option->long_name());
      std::string name = error.get_option_name();
      name = name.substr(0, name.find('='));
      throw InputError("unknown option \"" + name + "\"; " + name_suggestion(name, names));
    }
    catch (const options::error &error)
    {
      throw InputError("command line: " + std::string(error.what()) + "; see vibrocontact --help");
    }

    CommandLine result;
    result.check = given.count("check") > 0;
    result.parameters = given.count("parameters") > 0;
    result.resume = given.count("resume") > 0;
    result.quiet = given.count("quiet") > 0;
    result.version = given.count("version") > 0;
    result.help = given.count("help") > 0;
    if (given.count("output"))
      result.output = given["output"].as<std::string>();
    if (given.count("set"))
      result.overrides = given["set"].as<std::vector<std::string>>();

    const auto files =
        given.count("file") ? given["file"].as<std::vector<std::string>>() : std::vector<std::string>();
    if (files.size() > 1)
      throw InputError("one parameter file at a time, but " + quoted_list(files, "and") + " were given");
    if (!files.empty())
      result.file = files[0];
    else if (!result.parameters && !result.version && !result.help)
      throw InputError("no parameter file was given; write vibrocontact FILE.prm, or --help for the options");
    if (given.count("output") && result.output.empty())
      throw InputError("--output needs the name of a folder");
    return result;
  }
} // namespace vibrocontact
