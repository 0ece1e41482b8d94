// Frequency responses in files: what is written comes back bit by bit, hand-written files are understood, wrong ones refused.
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/lsce.h>
#include <vibrocontact/receptances/frequency_csv.h>
#include <vibrocontact/receptances/frequency_file.h>
#include <vibrocontact/receptances/uff58.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  FrequencyData sample(const double step = 0.5)
  {
    FrequencyData data;
    data.labels = {"left_z", "right_x"};
    for (unsigned int l = 0; l < 5; ++l)
      data.frequency.push_back(2 + l * step);
    for (const auto &[i, j] : {std::make_pair(0u, 0u), std::make_pair(0u, 1u), std::make_pair(1u, 1u)})
    {
      FrequencyData::Entry entry;
      entry.response = i;
      entry.reference = j;
      for (unsigned int l = 0; l < 5; ++l)
        entry.values.emplace_back(std::sin(1 + l + i) * 1e-6, -std::exp(0.3 * l + j) / 3);
      data.entries.push_back(entry);
    }
    return data;
  }

  void expect_equal(const FrequencyData &a, const FrequencyData &b)
  {
    EXPECT_EQ(a.labels, b.labels);
    EXPECT_EQ(a.frequency, b.frequency);
    ASSERT_EQ(a.entries.size(), b.entries.size());
    for (unsigned int k = 0; k < a.entries.size(); ++k)
    {
      EXPECT_EQ(a.entries[k].response, b.entries[k].response);
      EXPECT_EQ(a.entries[k].reference, b.entries[k].reference);
      EXPECT_EQ(a.entries[k].values, b.entries[k].values);
    }
  }

  std::string message(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing was refused";
  }

  std::string refused(const std::string &name, const std::string &bytes, const bool rolling = false)
  {
    return message([&] { read_frequency_data(name, bytes, {rolling}); });
  }

  // a table of one impulse response, read
  FrequencyData of_samples(const double step, const std::vector<double> &values)
  {
    std::string text = "time_s,a_z_a_z_m_Ns\n";
    char line[80];
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      std::snprintf(line, sizeof line, "%.17g,%.17g\n", n * step, values[n]);
      text += line;
    }
    return read_frequency_data("g.csv", text, {});
  }

  void expect_words(const std::string &text, const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << text << " lacks " << word;
  }
} // namespace

TEST(FrequencyData, TableComesBackBitByBit)
{
  const FrequencyData data = sample(1 / 3.);
  const std::string text = frequency_csv(data, {"a comment"});
  const FrequencyData back = read_frequency_data("x.csv", text, {});
  expect_equal(data, back);
  EXPECT_EQ(text, frequency_csv(back, {"a comment"}));
}

TEST(FrequencyData, UniversalFileComesBackBitByBit)
{
  const FrequencyData data = sample();
  expect_equal(data, read_frequency_data("x.uff", uff58_text(data, "title", true), {}));
  for (const double step : {0.5, 1 / 3.})
    for (const bool binary : {false, true})
    {
      // once written, twice the same
      const std::string text = uff58_text(sample(step), "title", binary);
      const FrequencyData back = read_uff58("x.uff", text);
      EXPECT_EQ(text, uff58_text(back, "title", binary));
      for (unsigned int l = 0; l < 5; ++l)
      {
        EXPECT_NEAR(back.frequency[l], sample(step).frequency[l], 1e-8);
        EXPECT_NEAR(back.entries[1].values[l].imag() / sample(step).entries[1].values[l].imag(), 1, 1e-12);
      }
    }
  // an uneven axis
  FrequencyData uneven = data;
  uneven.frequency = {1, 2, 4, 8, 16};
  for (const bool binary : {false, true})
  {
    const std::string text = uff58_text(uneven, "title", binary);
    const FrequencyData back = read_uff58("x.uff", text);
    EXPECT_EQ(back.frequency, uneven.frequency);
    EXPECT_EQ(text, uff58_text(back, "title", binary));
  }
}

namespace
{
  /// written by hand after the format's description: an accelerance in single precision, uneven
  const std::string foreign =
      "    -1\n"
      "   164\n"
      "         1  SI: m, N             2\n"
      "  1.0000000000000000D+00\n"
      "    -1\n"
      "    -1\n"
      "    58\n"
      "Hammer test\n"
      "NONE\n"
      "21-Nov-26 12:00:00\n"
      "NONE\n"
      "NONE\n"
      "    4         1    0         0 NONE              12   3 NONE              12  -3\n"
      "         5         3         0  0.00000E+00  0.00000E+00  0.00000E+00\n"
      "        18    0    0    0 Frequency            Hz                  \n"
      "        12    1    0    0 Acceleration         m/s^2               \n"
      "        13    0    1    0 Force                N                   \n"
      "         0    0    0    0 NONE                 NONE                \n"
      "  1.00000E+00  2.00000E+00  0.00000E+00  2.00000E+00  0.00000E+00 -4.00000E+00\n"
      "  5.00000E+00 -1.00000E+00  1.00000E+00\n"
      "    -1\n";
} // namespace

TEST(FrequencyData, ForeignUniversalFile)
{
  // struck downwards, measured upwards: a driving point with its sign turned
  const FrequencyData data = read_frequency_data("hammer.unv", foreign, {});
  EXPECT_EQ(data.labels, std::vector<std::string>{"12_z"});
  ASSERT_EQ(data.frequency, (std::vector<double>{1, 2, 5}));
  // receptance = accelerance / (j omega)^2
  EXPECT_NEAR(std::abs(data.entries[0].values[1] * 16. * M_PI * M_PI + Complex(0, 4)), 0, 1e-12);
}

namespace
{
  /// one function of a universal file over time or frequency, real, one abscissa per value
  std::string uneven_function(const int type, const int axis, const std::vector<double> &abscissa)
  {
    char line[128];
    std::snprintf(line, sizeof line,
                  "%5d         1    0         0 NONE               1   3 NONE               1   3\n", type);
    std::string text = std::string("    -1\n    58\nTest\nNONE\nNONE\nNONE\nNONE\n") + line;
    std::snprintf(line, sizeof line, "         2%10zu         0  0.00000E+00  0.00000E+00  0.00000E+00\n",
                  abscissa.size());
    text += line;
    std::snprintf(line, sizeof line, "%10d    0    0    0 axis                 NONE\n", axis);
    text += line;
    text +=
        "         8    1    0    0 Displacement         m\n        13    0    1    0 Force                N\n"
        "         0    0    0    0 NONE                 NONE\n";
    for (unsigned int i = 0; i < abscissa.size(); ++i)
    {
      std::snprintf(line, sizeof line, "%13.5E%13.5E%s", abscissa[i], std::exp(-1. * i),
                    i % 3 == 2 || i + 1 == abscissa.size() ? "\n" : "");
      text += line;
    }
    return text + "    -1\n";
  }
} // namespace

TEST(FrequencyData, UniversalFileOfOtherFunctions)
{
  const std::vector<double> even = {0, 0.001, 0.002, 0.003, 0.004, 0.005},
                            uneven = {0, 0.001, 0.002, 0.004, 0.008}, frequencies = {1, 2, 3, 4};
  // impulse responses: equal steps, to the 6 digits of the file
  const FrequencyData impulse = read_uff58("g.uff", uneven_function(1, 17, even));
  EXPECT_NEAR(impulse.frequency[1], 1 / (6 * 0.001), 1e-9);
  expect_words(refused("g.uff", uneven_function(1, 17, uneven)), {"g.uff", "equal steps"});
  // coherence (6), auto spectrum (2) and a time record over frequency beside a response are left aside, and counted
  const std::string response = uneven_function(4, 18, frequencies);
  const FrequencyData data =
      read_frequency_data("h.uff",
                          uneven_function(6, 18, frequencies) + response + uneven_function(2, 18, even) +
                              uneven_function(1, 18, frequencies),
                          {});
  EXPECT_EQ(data.entries.size(), 1);
  EXPECT_EQ(data.n_skipped, 3);
  expect_equal(data, read_uff58("h.uff", response));
  expect_equal(data, read_uff58("h.uff", uneven_function(0, 18, frequencies)));
  expect_words(refused("h.uff", uneven_function(6, 18, frequencies)), {"1 with other functions"});
}

TEST(FrequencyData, AccelerationsAfterABlowLackTheBlow)
{
  std::string accelerations = uneven_function(1, 17, {0, 0.001, 0.002, 0.003, 0.004, 0.005});
  accelerations.replace(accelerations.find("         8    1    0    0 Displacement         m"), 10,
                        "        12");
  accelerations.replace(accelerations.find("Displacement         m") + 21, 1, "m/s^2");
  expect_words(refused("g.uff", accelerations), {"g.uff", "acceleration after a blow", "1 / mass"});
}

TEST(FrequencyData, NamesOfPointsDiffer)
{
  const auto driving_point = [](const std::string &entity, const int node)
  {
    std::string text = foreign;
    char line[96];
    std::snprintf(line, sizeof line, "    4         1    0         0 %-10s%10d   3 %-10s%10d   3\n",
                  entity.c_str(), node, entity.c_str(), node);
    const std::size_t at = text.find("    4         1    0");
    return text.replace(at, text.find('\n', at) + 1 - at, line);
  };
  const FrequencyData data =
      read_uff58("p.uff", driving_point("P2", 1) + driving_point("P", 1) + driving_point("P", 2));
  EXPECT_EQ(std::set<std::string>(data.labels.begin(), data.labels.end()).size(), 3u);
}

TEST(FrequencyData, ImpulseResponse)
{
  // m = 1, omega_d = 100, decay 20: G = 1 / ((s + 20)^2 + 100^2)
  const double step = 1e-4;
  std::vector<double> values;
  for (unsigned int n = 0; n < 20000; ++n)
  {
    const double t = n * step;
    values.push_back(std::exp(-20 * t) * std::sin(100 * t) / 100);
  }
  const FrequencyData data = of_samples(step, values);
  EXPECT_NEAR(data.frequency[1], 0.5, 1e-12);
  for (const unsigned int l : {0u, 20u, 60u})
  {
    const Complex s(20, 2 * M_PI * data.frequency[l]);
    EXPECT_LT(std::abs(data.entries[0].values[l] * (s * s + 1e4) - 1.), 1e-4);
  }
}

namespace
{
  // three modes of m = 1 and 2 % damping up to 100 rad/s, sampled until they have decayed
  constexpr double damped_modes[] = {20, 50, 100}, damping = 0.02;

  Complex receptance_of_modes(const double frequency)
  {
    const Complex s(0, 2 * M_PI * frequency);
    Complex sum = 0;
    for (const double w : damped_modes)
      sum += 1. / ((s + damping * w) * (s + damping * w) + w * w);
    return sum;
  }

  // of a blow that comes so much after t = 0
  FrequencyData of_struck_modes(const double step, const unsigned int n, const double late = 0)
  {
    std::vector<double> values(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (const double w : damped_modes)
        if (const double t = i * step - late; t > 0)
          values[i] += std::exp(-damping * w * t) * std::sin(w * t) / w;
    return of_samples(step, values);
  }
} // namespace

TEST(FrequencyData, ImagesOfABlowAreTakenOff)
{
  // trapezoids alone are off by 1.5 of the value at the upper lines
  const FrequencyData data = of_struck_modes(0.6e-2, 8192);
  EXPECT_EQ(data.n_without_blow, 0u);
  for (std::size_t l = 0; l < data.frequency.size(); ++l)
  {
    const Complex exact = receptance_of_modes(data.frequency[l]);
    EXPECT_LT(std::abs(data.entries[0].values[l] - exact), 1e-3 * std::abs(exact)) << l;
  }
}

// A spectrum that ends at half the sampling rate has no images: what is made of it comes back.
TEST(FrequencyData, BandLimitedResponsesStay)
{
  const unsigned int n = 8192;
  const double step = 0.6e-2;
  Spectra band;
  band.values.emplace_back();
  for (unsigned int l = 0; l <= n / 2; ++l)
  {
    band.omega.push_back(2 * M_PI * l / (n * step));
    band.values[0].push_back(receptance_of_modes(l / (n * step)));
  }
  std::vector<Complex> &lines = band.values[0];
  lines.back() = lines.back().real();
  std::vector<double> values = impulse_responses(band).values[0];
  values[0] *= 2; // counts half
  const FrequencyData data = of_samples(step, values);
  EXPECT_EQ(data.n_without_blow, 1u);
  for (unsigned int l = 0; l < lines.size(); ++l)
    EXPECT_LT(std::abs(data.entries[0].values[l] - lines[l]), 1e-9 * std::abs(lines[l]) + 1e-15) << l;
}

TEST(FrequencyData, BlowsBetweenTwoSamplesAndRareSamplesAreNoBlowsAtZero)
{
  EXPECT_EQ(of_struck_modes(0.6e-2, 8192, 0.3e-2).n_without_blow, 1u);
  EXPECT_EQ(of_struck_modes(1.6e-2, 2048).n_without_blow, 1u);
}

TEST(FrequencyData, WrongDataAreRefused)
{
  const std::string head = "# measured\nfrequency_Hz,a_z_a_z_real_m_N,a_z_a_z_imag_m_N\n";
  const auto rows = [&](const std::vector<std::string> &frequencies)
  {
    std::string text = head;
    for (const std::string &frequency : frequencies)
      text += frequency + ",1,0\n";
    return text;
  };
  expect_words(refused("d.csv", rows({"1", "3", "2"})), {"d.csv", "line 5", "sort"});
  expect_words(refused("d.csv", rows({"-1", "0", "1"})), {"d.csv", "line 3", "not negative"});
  expect_words(refused("d.csv", rows({"1", "2", "3", "4", "5", "6", "8", "9", "10"})),
               {"line 9", "gap between 6 and 8"});
  expect_words(refused("d.csv", head + "1,1,0\n2,nan,0\n3,1,0\n"), {"line 4", "nan", "number"});
  expect_words(refused("d.csv", head + "1,1,0\n2,,0\n3,1,0\n"), {"line 4", "no value"});
  expect_words(refused("d.csv", rows({"1", "2"})), {"at least 3"});
  expect_words(refused("d.csv", "frequency_Hz,a_z_b_z_real_m_N,a_z_b_z_imag_m_N\n1,1,0\n2,1,0\n3,1,0\n"),
               {"a_z_b_z", "driven"});
  // logarithmic axes are as good
  EXPECT_EQ(refused("d.csv", rows({"1", "2", "4", "8", "16", "32", "64"})), "nothing was refused");

  FrequencyData data = sample();
  data.entries.push_back(data.entries[1]);
  std::swap(data.entries.back().response, data.entries.back().reference);
  data.entries.back().values[2] *= 3;
  const std::string text = frequency_csv(data, {});
  expect_words(refused("d.csv", text), {"not reciprocal", "right_x", "left_z", "Rolling data"});
  EXPECT_EQ(refused("d.csv", text, true), "nothing was refused");
  expect_words(refused("d.csv", frequency_csv(sample(), {}), true), {"lack", "both ways"});

  std::string uff = uff58_text(sample(), "title", false), other = uff58_text(sample(0.25), "title", false);
  expect_words(refused("d.uff", uff + other), {"d.uff", "line", "axis differs"});
  expect_words(refused("d.uff", uff.substr(0, uff.size() / 2)), {"not complete"});
  expect_words(refused("d.uff", "nothing"), {"no dataset 58"});
  std::string inches = foreign;
  inches.replace(inches.find("         1  SI"), 10, "         7");
  expect_words(refused("d.unv", inches), {"line 3", "SI"});
  const auto labelled = [&](const std::string &unit, const std::string &other)
  {
    std::string text = foreign;
    const std::size_t place = text.find(unit + "  ", text.find("Frequency"));
    text.replace(place, 20, (other + std::string(20, ' ')).substr(0, 20));
    return refused("d.unv", text);
  };
  expect_words(labelled("m/s^2", "g"), {"line 21", "function of line 13", "numerator", "'g'", "SI"});
  expect_words(labelled("m/s^2", "mm/s^2"), {"'mm/s^2'"});
  expect_words(labelled("m/s^2", "m"), {"'m'"});
  expect_words(labelled("N", "lbf"), {"denominator", "'lbf'"});
  expect_words(labelled("Hz", "kHz"), {"abscissa", "'kHz'"});
  for (const std::string other :
       {"m/Ns", "mm/ms^2", "mm/ms2", "10 m/s^2", "m/s^21", "m/s^(2", "m/N s^2", "Nm", "mN/kg"})
    expect_words(labelled("m/s^2", other), {"'" + other + "'"});
  for (const std::string other : {"10 N", "mN", "kN", "Nm"})
    expect_words(labelled("N", other), {"'" + other + "'"});
  expect_words(labelled("Hz", "ms"), {"'ms'"});
  for (const std::string same : {"NONE", "null", "", "M/S2", "m/s\u00b2", "(m/sec**2)/N", "m/s/s", "m s^-2",
                                 "m.s-2", "ms^-2", "m\u00b7s-2", "m/(s^2 N)", "m/(N s^2)", "1/kg",
                                 "Meters/sec^2", "M/SEC**2", "m s\u207b\u00b2", "m/(N*s^2)", "m/s^(2)"})
    EXPECT_EQ(labelled("m/s^2", same), "nothing was refused") << same;
  for (const std::string same : {"Newton", "NEWTONS", "n", "kg m/s^2"})
    EXPECT_EQ(labelled("N", same), "nothing was refused") << same;
  for (const std::string same : {"Hertz", "1/s", "s^-1", "HZ"})
    EXPECT_EQ(labelled("Hz", same), "nothing was refused") << same;
  std::string unsaid = foreign;
  unsaid.replace(unsaid.find("        12    1    0    0 Acc"), 10, "         0");
  expect_words(refused("d.unv", unsaid), {"'m/s^2'", "acceleration 12"});
  // a mobility is no receptance, nor a length per length
  for (const std::string other : {"m/(N s)", "mm/m", "mm/Nm"})
  {
    std::string mobility = unsaid;
    const std::size_t place = mobility.find("m/s^2  ");
    mobility.replace(place, 20, (other + std::string(20, ' ')).substr(0, 20));
    expect_words(refused("d.unv", mobility), {"'" + other + "'"});
  }
  std::string hole = foreign;
  hole.replace(hole.find(" -1.00000E+00"), 13, "          NaN");
  expect_words(refused("d.unv", hole), {"line 20", "NaN"});
}

TEST(FrequencyData, DirectionsAgainstAxes)
{
  // a downward hammer at A, an accelerometer downwards at B: A_z, B_z with signs
  std::string text = "frequency_Hz,A_-z_A_-z_real_m_N,A_-z_A_-z_imag_m_N,A_-z_B_z_real_m_N,A_-z_B_z_imag_m_N,"
                     "B_z_B_z_real_m_N,B_z_B_z_imag_m_N\n";
  for (const char *frequency : {"1", "2", "3"})
    text += std::string(frequency) + ",5,-1,3,-0.5,4,-2\n";
  const FrequencyData data = read_frequency_data("a.csv", text, {});
  EXPECT_EQ(data.labels, (std::vector<std::string>{"A_z", "B_z"}));
  EXPECT_EQ(data.find(0, 0)->values[1], Complex(5, -1));
  EXPECT_EQ(data.find(0, 1)->values[1], Complex(-3, 0.5));
  EXPECT_EQ(data.find(1, 1)->values[1], Complex(4, -2));
  // the same point twice under two names
  text.replace(text.find("B_z_B_z"), 7, "A_z_A_z");
  EXPECT_NE(refused("a.csv", text), "nothing was refused");
}

TEST(FrequencyData, BandAndDelay)
{
  std::string text = "frequency_Hz,a_z_a_z_real_m_Ns2,a_z_a_z_imag_m_Ns2\n";
  for (unsigned int f = 0; f <= 10; ++f)
    text += std::to_string(f) + ",1,0.1\n";
  expect_words(refused("b.csv", text), {"0 Hz", "Lower frequency"});
  DataRules rules;
  rules.lower = 2;
  rules.upper = 6;
  rules.delay = 1e-3;
  const FrequencyData data = read_frequency_data("b.csv", text, rules);
  EXPECT_EQ(data.frequency, (std::vector<double>{2, 3, 4, 5, 6}));
  const double omega = 2 * M_PI * 3;
  EXPECT_LT(
      std::abs(data.entries[0].values[1] + Complex(1, 0.1) / (omega * omega) * std::polar(1., omega * 1e-3)),
      1e-15);
  rules.upper = 3.5;
  expect_words(message([&] { read_frequency_data("b.csv", text, rules); }), {"Upper frequency", "2 lines"});
}

// Noise that is even in accelerances: 1 % of their rms, but more than all of the receptance on the lowest lines.
TEST(FrequencyData, ReciprocityIsJudgedInTheQuantityOfTheFile)
{
  std::string text = "frequency_Hz";
  for (const char *pair : {"a_z_a_z", "a_z_b_z", "b_z_a_z", "b_z_b_z"})
    text += std::string(",") + pair + "_real_m_Ns2," + pair + "_imag_m_Ns2";
  text += "\n";
  unsigned int state = 1;
  const auto noise = [&]
  {
    state = 1664525 * state + 1013904223;
    return 0.02 * (state / 4294967296. - 0.5);
  };
  for (unsigned int f = 1; f <= 400; ++f)
  {
    text += std::to_string(f);
    const double omega = 2 * M_PI * f;
    const Complex accelerance = -omega * omega / Complex(800. * 800 - omega * omega, 0.05 * 800 * omega);
    for (const double share : {1., 0.6, 0.6, 0.8})
      text += "," + std::to_string(share * accelerance.real() + noise()) + "," +
              std::to_string(share * accelerance.imag() + noise());
    text += "\n";
  }
  EXPECT_EQ(refused("c.csv", text), "nothing was refused");
  // the same difference on all lines is one
  text.replace(text.find("b_z_a_z_real"), 12, "x_z_x_z_real");
  text.replace(text.find("b_z_a_z_imag"), 12, "x_z_x_z_imag");
  EXPECT_NE(refused("c.csv", text), "nothing was refused");
}
