// Wrong parameter files are refused in one sentence that says where, what and the nearest valid names.
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_file.h>

#include <gtest/gtest.h>

#include <cfloat>

using namespace vibrocontact;
using dealii::ParameterHandler;
namespace Patterns = dealii::Patterns;

namespace
{
  struct Values
  {
    double friction = 0.3;
    std::vector<double> force;
    std::string scheme = "first order";
    int points = 10;
    bool coupled = true;
  };

  void declare(ParameterHandler &prm, Values &values)
  {
    prm.declare_entry("Bodies", "", Patterns::Anything(), "Names of the bodies. Units: none.");
    prm.enter_subsection("Contact");
    prm.add_parameter("Friction coefficient", values.friction, "Friction. Units: none.", Patterns::Double(0));
    prm.add_parameter("Creep scheme", values.scheme, "Scheme. Units: none.",
                      Patterns::Selection("first order|second order"));
    prm.enter_subsection("Inner");
    prm.add_parameter("Points", values.points, "Points. Units: none.", Patterns::Integer(1, 100));
    prm.add_parameter("Coupled", values.coupled, "Coupling. Units: none.");
    prm.leave_subsection();
    prm.leave_subsection();
    prm.enter_subsection("Rolling");
    prm.add_parameter("Normal force", values.force, "Force. Units: N.",
                      Patterns::List(Patterns::Double(DBL_MIN), 0, 1));
    prm.leave_subsection();
  }

  Values parse(const std::string &text, const std::vector<std::string> &options = {})
  {
    Values values;
    ParameterHandler prm;
    declare(prm, values);
    ParameterFile("case.prm", text, options).parse(prm);
    return values;
  }

  /// The message of the error, or "no error".
  std::string error(const std::string &text, const std::vector<std::string> &options = {})
  {
    try
    {
      parse(text, options);
    }
    catch (const InputError &e)
    {
      return e.what();
    }
    return "no error";
  }
} // namespace

#define EXPECT_SAYS(message, part)                                                                           \
  EXPECT_NE(std::string(message).find(part), std::string::npos) << "says: " << (message)

TEST(ParameterFile, ReadsSectionsContinuationsAndComments)
{
  const Values values =
      parse("set Bodies = a, \\\n b # two\nsubsection Contact\n set Friction coefficient = 0.25\r\n"
            "subsection Inner\n set Points = 7\n set Coupled = false\n end\nend\n"
            "subsection Rolling\n set Normal force = 66e3\nend");
  EXPECT_EQ(values.friction, 0.25);
  EXPECT_EQ(values.points, 7);
  EXPECT_FALSE(values.coupled);
  ASSERT_EQ(values.force.size(), 1u);
  EXPECT_EQ(values.force[0], 66e3);
}

TEST(ParameterFile, OptionsOverride)
{
  EXPECT_EQ(
      parse("subsection Contact\nset Friction coefficient = 0.1\nend", {"Contact/Friction coefficient=0.6"})
          .friction,
      0.6);
  EXPECT_SAYS(error("", {"Contact/Friction coeficient=0.6"}), "did you mean \"Friction coefficient\"?");
  EXPECT_SAYS(error("", {"Contact/Friction coefficient=-1"}),
              "--set \"Contact/Friction coefficient\": entry");
  EXPECT_SAYS(error("", {"Contact"}), "names no entry or no value");
}

TEST(ParameterFile, UnknownNames)
{
  EXPECT_SAYS(error("\nsubsection Contact\n set Friction coeficient = 0.3\nend"),
              "case.prm:3: section Contact has no entry \"Friction coeficient\"; did you mean \"Friction "
              "coefficient\"?");
  EXPECT_SAYS(error("subsection Contakt\nend"),
              "case.prm:1: the top level has no subsection \"Contakt\"; did you mean \"Contact\"?");
  EXPECT_SAYS(error("subsection Contact\n set Normal force = 1\nend"), "belongs to \"Rolling\"");
  EXPECT_SAYS(error("subsection Contact\n subsection Outer\n end\nend"),
              "section Contact has no subsection \"Outer\"; valid is \"Inner\"");
}

TEST(ParameterFile, Structure)
{
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = 1\nsubsection Rolling\nend\n"),
              "case.prm:1: subsection \"Contact\" is never closed; add a line \"end\" before line 3");
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = 1\n"),
              "case.prm:1: subsection \"Contact\" is never closed");
  EXPECT_SAYS(error("subsection Contact\nend\nend\n"), "case.prm:3: this \"end\" closes nothing");
  EXPECT_SAYS(error("Bodies = a\n"), "write \"set\" in front of it");
  EXPECT_SAYS(error("set Bodies\n"), "sets nothing");
  EXPECT_SAYS(error("set Bodies = a\nset Bodies = b\n"),
              "case.prm:2: entry \"Bodies\" of the top level is set a second time");
}

TEST(ParameterFile, Values)
{
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = -0.3\nend"),
              "is \"-0.3\" but has to be a number of at least 0 (default 0.3)");
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = nan\nend"),
              "\"nan\", which is not a finite number");
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = 1e999\nend"), "not a finite number");
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient = 0,3\nend"), "has to be a number");
  EXPECT_SAYS(error("subsection Contact\nset Friction coefficient =\nend"), "has to be a number");
  EXPECT_SAYS(error("subsection Contact\nset Creep scheme = third order\nend"),
              "one of: first order, second order");
  EXPECT_SAYS(error("subsection Contact\nsubsection Inner\nset Points = 1.5\nend\nend"),
              "a whole number from 1 to 100");
  EXPECT_SAYS(error("subsection Contact\nsubsection Inner\nset Coupled = 7\nend\nend"), "true or false");
  EXPECT_SAYS(error("subsection Rolling\nset Normal force = 0\nend"),
              "empty or a number greater than 0, in N");
}

TEST(ParameterFile, Where)
{
  ParameterFile file("case.prm", "\nsubsection Contact\nset Friction coefficient = 0.1\nend",
                     {"Rolling/Normal force=3"});
  EXPECT_EQ(file.where("Contact", "Friction coefficient"),
            "case.prm:3, section Contact, entry \"Friction coefficient\"");
  EXPECT_EQ(file.where("Rolling", "Normal force"), "--set \"Rolling/Normal force\"");
  EXPECT_EQ(file.where_section("Contact"), "case.prm:2, section Contact");
}

TEST(ParameterFile, MessagesNameTheOptionsThatCausedThem)
{
  const ParameterFile file("case.prm", "\nsubsection Rolling\nset Speed = 1\nend",
                           {"Rolling/Normal force=3", "Rolling/Hub displacement=1"});
  EXPECT_EQ(file.located("Rolling/Normal force and Rolling/Hub displacement are both given"),
            "--set \"Rolling/Normal force\" and --set \"Rolling/Hub displacement\": "
            "Rolling/Normal force and Rolling/Hub displacement are both given");
  EXPECT_SAYS(file.located("Rolling/Normal force at Rolling/Speed"),
              "--set \"Rolling/Normal force\" and case.prm:3: Rolling/Normal force at");
  EXPECT_SAYS(file.located("Rolling/Speed is 1"), "case.prm:3: Rolling/Speed");
  EXPECT_SAYS(file.located("Rolling makes no sense"), "case.prm:2: Rolling makes");
  EXPECT_SAYS(file.located("nothing known"), "case.prm: nothing");
}

TEST(ParameterFile, AByteOrderMarkIsSkipped)
{
  EXPECT_EQ(parse("\xef\xbb\xbfsubsection Contact\nset Friction coefficient = 0.25\nend").friction, 0.25);
  EXPECT_SAYS(error("\xef\xbb\xbfset Bodys = a"), "case.prm:1: ");
}

TEST(ParameterFile, FileNamesCountFromTheFolderOfTheFile)
{
  const ParameterFile file("/somewhere/case.prm", "");
  EXPECT_EQ(file.resolved_path("meshes/../a.msh"), "/somewhere/a.msh");
  EXPECT_EQ(file.resolved_path("/b.msh"), "/b.msh");
  std::string name;
  ParameterHandler prm;
  prm.add_parameter("File", name, "Mesh. Units: none.", Patterns::FileName());
  ParameterFile("/somewhere/case.prm", "set File = a.msh").parse(prm);
  EXPECT_EQ(name, "/somewhere/a.msh");
}

TEST(ParameterFile, AnOptionReplacesTheAlternativeInTheFile)
{
  ParameterFile file("case.prm", "subsection Rolling\nset Hub displacement = 0.1\nend",
                     {"Rolling/Normal force=3"});
  EXPECT_EQ(file.prefer_option("Rolling/Normal force", "Rolling/Hub displacement"),
            "Rolling/Hub displacement");
  EXPECT_EQ(file.raw_value("Rolling", "Hub displacement"), "");
  EXPECT_EQ(file.prefer_option("Rolling/Normal force", "Rolling/Hub displacement"), "");
}

TEST(ParameterFile, PrintedParametersAreAValidFileWithTheSameValues)
{
  Values values;
  ParameterHandler prm;
  declare(prm, values);
  const DeclaredParameters declared =
      ParameterFile("case.prm", "subsection Rolling\nset Normal force = 5\nend").parse(prm);
  EXPECT_EQ(print_parameters(declared, ParameterStyle::documented),
            print_parameters(declared_parameters(prm), ParameterStyle::documented));
  for (const ParameterStyle style : {ParameterStyle::documented, ParameterStyle::values_only})
    EXPECT_EQ(parse(print_parameters(declared_parameters(prm), style)).force, std::vector<double>{5});
  EXPECT_SAYS(print_parameters(declared_parameters(prm), ParameterStyle::documented),
              "# Force. Units: N.\n  # Value: empty or a number greater than 0. Default: empty.\n  set "
              "Normal force = 5\n");
}

TEST(NearestNames, DistanceCountsSwappedLettersOnce)
{
  EXPECT_EQ(edit_distance("Spin", "Spni"), 1u);
  EXPECT_EQ(edit_distance("Speed", "speed"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(nearest_names("Frction", {"Friction", "Speed"}), std::vector<std::string>{"Friction"});
  EXPECT_TRUE(nearest_names("xyz", {"Friction", "Speed"}).empty());
}
