# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""usage: check_kept.py SOURCE: what bench/kept.py makes of results, good, bad and strange."""
import os
import sys
import tempfile
import unittest

SOURCE = sys.argv.pop(1)
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(SOURCE, 'bench'))
import kept  # noqa: E402


def given_stages(**instructions):
    return {name: {'instructions': n, 'cpu_s': 1.0, 'memory_mb': 10, 'input': 7} for name, n in instructions.items()}


def given_run(commit, **instructions):
    return {'commit': commit, 'date': '2000-01-01', 'stages': given_stages(**instructions)}


class Comparing(unittest.TestCase):
    def remarks(self, before, now):
        rows, worse = kept.compare(before, now)
        return {stage: remark for stage, _, _, remark in rows}, worse

    def test_a_kept_result_with_15_percent_fewer_instructions_makes_a_regression(self):
        remarks, worse = self.remarks(given_stages(detect=850, filter=500), given_stages(detect=1000, filter=500))
        self.assertTrue(worse)
        self.assertEqual(remarks, {'detect': '**regression**', 'filter': ''})

    def test_5_percent_fewer_do_not(self):
        remarks, worse = self.remarks(given_stages(detect=950), given_stages(detect=1000))
        self.assertFalse(worse)
        self.assertEqual(remarks, {'detect': ''})

    def test_fewer_instructions_now_are_no_regression(self):
        remarks, worse = self.remarks(given_stages(detect=1000), given_stages(detect=700))
        self.assertFalse(worse)
        self.assertEqual(remarks, {'detect': 'better'})

    def test_other_input_new_and_lost_stages_are_told_and_not_compared(self):
        before = given_stages(detect=100, fit=100)
        before['detect']['input'] = 8
        remarks, worse = self.remarks(before, given_stages(detect=1000, net=1000))
        self.assertFalse(worse)
        self.assertEqual(remarks, {'detect': 'other input', 'net': 'new', 'fit': 'gone'})

    def test_every_row_of_the_table_is_whole(self):
        before, now = given_stages(detect=850, fit=100), given_stages(detect=1000, net=10)
        rows = list(kept.table_rows(kept.compare(before, now)[0], now))
        self.assertEqual([row[0] for row in rows], ['detect', 'net', 'fit'])
        self.assertTrue(all(len(row) == 7 for row in rows))
        self.assertIn('+17.6 %', rows[0])


class Keeping(unittest.TestCase):
    def test_what_is_kept_comes_back_in_its_order_and_a_commit_once(self):
        with tempfile.TemporaryDirectory() as folder:
            place = ('A Processor (TM) 7', 'GNU 12.2.0', 'perf')
            path = kept.path_for(os.path.join(folder, 'results'), *place)
            self.assertEqual(os.path.basename(path), 'a-processor-tm-7-gnu-12.2.0-perf.json')
            self.assertEqual(kept.read(path), [])
            for commit, n in (('a', 1), ('b', 2), ('a', 3)):
                kept.keep(path, *place, given_run(commit, detect=n))
            self.assertEqual([(r['commit'], r['stages']['detect']['instructions']) for r in kept.read(path)], [('b', 2), ('a', 3)])


if __name__ == '__main__':
    unittest.main()
