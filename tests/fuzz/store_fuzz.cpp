// Stores of sweeps: any file is one and answers a query, or is refused.

#include <filesystem>
#include <fstream>

#include "base/run_program.h"
#include "fuzz_text.h"
#include "studies/sweep/store_query.h"
#include "studies/sweep/sweep_store.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  namespace fs = std::filesystem;
  static const TemporaryFolder folder("slipcheck-fuzz", fs::temp_directory_path());
  // SQLite looks for more files of that name.
  for (const fs::directory_entry& old : fs::directory_iterator(folder.path())) fs::remove(old);
  const fs::path path = folder.path() / "store.db";
  std::ofstream(path, std::ios::binary) << fuzz::text(data, size);
  try {
    const auto store = open_store(path);
    head_of(*store);
    for (const auto rows :
         {StoreQuery::Rows::runs, StoreQuery::Rows::observables, StoreQuery::Rows::phases}) {
      StoreQuery query;
      query.rows = rows;
      query.limit = 100;
      query_store(*store, query);
    }
  } catch (const BadStore&) {
  } catch (const BadQuery&) {
  } catch (const SqliteFailure&) {
  }
  return 0;
}
