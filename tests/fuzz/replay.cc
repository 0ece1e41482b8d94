// Gives every file of the corpus to its reader: replay_corpus FOLDER, with a folder per reader in it. Each input is taken or
// refused in a sentence; anything else ends the program.
#include "readers.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

int main(int argc, char **argv)
{
  namespace fs = std::filesystem;
  if (argc != 2)
  {
    std::cout << "usage: replay_corpus FOLDER\n";
    return 1;
  }
  const fs::path corpus = fs::absolute(argv[1]);
  const std::shared_ptr<void> session = readers::start(argv);
  bool good = true;
  for (const readers::Reader &reader : readers::all)
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(corpus / reader.name))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path &file : files)
    {
      std::ifstream stream(file, std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
      // said before it is read: a signal leaves no time
      std::cout << reader.name << "/" << file.filename().string() << std::flush;
      try
      {
        reader.read(bytes);
        std::cout << "\n";
      }
      catch (const std::exception &error)
      {
        std::cout << ": " << error.what() << "\n";
        good = false;
      }
    }
    good = good && !files.empty();
  }
  return good ? 0 : 1;
}
