# The headers of the library's interface: what users include, and what Doxygen describes. Headers that these
# include are installed as well; they are no part of the interface.
set(COORDREQ_PUBLIC_HEADERS
  base/error.hpp base/thread_team.hpp
  numeric/rational.hpp
  spec/problem_spec.hpp spec/read_spec.hpp
  model/uniform_grid.hpp model/input_space.hpp model/cell_block.hpp model/locate.hpp
  results/read_info.hpp results/results_reader.hpp results/version.hpp
  cell/state_query.hpp cell/state_text.hpp
  answers/checking/tally.hpp
  verify/verify.hpp verify/verify_file.hpp
  export/formats.hpp export/cell_table.hpp
  analysis/analyze.hpp cell/simulate.hpp cell/simulation.hpp
  cell/closed_loop.hpp)

# `doc`: what Doxygen makes of them.
list(TRANSFORM COORDREQ_PUBLIC_HEADERS PREPEND ${PROJECT_SOURCE_DIR}/lib/ OUTPUT_VARIABLE doxygen_input)
list(JOIN doxygen_input " " doxygen_input)
set(doxygen_input "${PROJECT_SOURCE_DIR}/scripts/doxygen/library.md ${doxygen_input}")
configure_file(${PROJECT_SOURCE_DIR}/scripts/doxygen/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
add_custom_target(doc COMMAND doxygen ${PROJECT_BINARY_DIR}/Doxyfile VERBATIM)
