#pragma once

#include "app/command_line.hpp"

// One function a command: does the work and prints the result; errors are thrown.
namespace coordreq {

ExitCode run_analyze(const CommandLine& line);
ExitCode run_validate(const CommandLine& line);
ExitCode run_info(const CommandLine& line);
ExitCode run_query(const CommandLine& line);
ExitCode run_simulate(const CommandLine& line);
ExitCode run_verify(const CommandLine& line);
ExitCode run_compare(const CommandLine& line);
ExitCode run_export(const CommandLine& line);
ExitCode run_report(const CommandLine& line);
ExitCode run_schema(const CommandLine& line);
ExitCode run_completion(const CommandLine& line);

}  // namespace coordreq
