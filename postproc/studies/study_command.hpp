#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// The command line: cupola-post study STUDY.yaml --members FILE | --runs FOLDER --output FOLDER [--pages
/// FOLDER]
///
/// With --members it lists the runs that the study needs; with --runs it measures the finished ones and
/// writes study.html and a CSV file per table; with --pages it also writes the tables and pictures of the
/// documentation. The exit code is `failed` if runs are missing, which are then named and no page is written.
ExitCode run_study(int argc, const char* const* argv);

}  // namespace cupola
