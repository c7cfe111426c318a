"""Durable jobs: long plans, comparisons and sweeps that outlive the process that works on them.

Endpoints (`routes`) turn to a desk, which asks the service in threads: submit, read, stop. Jobs are
kept in the store and wait in the queues, both in the database. In each process that takes jobs from
there, one worker runs them slice by slice, as plans or as studies of several plans, and calls
webhooks; beside it one housekeeper gives on the jobs of processes that are gone and deletes old
ones. `setup` builds each of them once.
"""
