#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// The command line: cupola-post study STUDY.yaml --members FILE | --runs FOLDER --output FOLDER [--pages
/// FOLDER]
///
/// With --members it lists the runs that the study needs; with --runs it measures the finished ones and
/// writes study.html and a CSV file per table; with --pages it also writes the tables and pictures of the
/// documentation. Missing runs are named. They make the exit code `failed`, except of a page of answers whose
/// run of the verdict has ended.
ExitCode run_study(int argc, const char* const* argv);

}  // namespace cupola
